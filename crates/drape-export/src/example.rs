//! Example of a run, for the tests: two panels, one with an odd name, that fall beside a box.

use std::fs;
use std::path::Path;

use drape_frames::Frame;
use npyz::WriterBuilder;
use npyz::half::f16;
use serde_json::json;
use tempfile::TempDir;

/// Name with letters that formats do not expect.
pub(crate) const HOSTILE: &str = "back \"</a>{}'\\ #1/袖;\u{e9}&amp;";

/// Corners and triangles of a cube of a metre.
pub(crate) fn cube() -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let corners = (0..8_u32).map(|k| [k & 1, k >> 1 & 1, k >> 2].map(f64::from));
    let faces =
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let triangles = faces.into_iter().flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]);
    (corners.collect(), triangles.collect())
}

/// Panels with `names`.
pub(crate) fn parts(names: &[&str]) -> Vec<drape_frames::SurfacePart> {
    let parts = names.iter().map(|name| drape_frames::SurfacePart {
        name: (*name).to_owned(),
        ..drape_frames::SurfacePart::default()
    });
    parts.collect()
}

/// Frame with the cloth at positions, in m.
pub(crate) fn frame(cloth: &[[f64; 3]]) -> Frame {
    Frame { cloth: cloth.to_vec(), ..Frame::default() }
}

/// Positions of the cloth at a time, in m.
pub(crate) fn cloth(time: f64) -> Vec<[f64; 3]> {
    let y = 1.0 - time / 3.0;
    let front = [[0.0, y, 0.0], [0.1, y, 0.0], [0.0, y, 0.2], [0.1, y, 0.2]];
    let back = [[0.0, y, 0.0], [0.0, y - 0.5, 0.0], [0.1, y, 0.0]];
    [&front[..], &back].concat()
}

/// Pressure of contact at the third vertex in a frame after the first, in Pa.
fn pressure(number: usize) -> f64 {
    0.5 + number as f64
}

/// Folder of a run of one frame with one panel, which lies flat.
pub(crate) fn folder_of_panel(material: &[[f64; 2]], triangles: &[[u32; 3]]) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let (vertices, count) = (material.len(), triangles.len());
    let panel = json!({ "name": "sheet", "vertices": vertices, "triangles": count });
    let manifest = json!({ "format": 2, "guarded": false, "panels": [panel], "bodies": [] });
    fs::write(folder.path().join("surfaces.json"), format!("{manifest}\n")).unwrap();
    fs::write(folder.path().join("frames.csv"), "number,time,growth,bodies\n0,0.0,1.0,\n").unwrap();
    array(&folder.path().join("triangles.npy"), triangles);
    array(&folder.path().join("material.npy"), material);
    let flat: Vec<[f64; 3]> = material.iter().map(|[x, z]| [*x, 0.0, *z]).collect();
    array(&folder.path().join("frame-00000.npy"), &flat);
    folder
}

/// Folder of a run with a frame at each of `times`, in s.
pub(crate) fn folder(times: &[f64]) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let weft = [0.0, 1.0];
    let manifest = json!({
        "format": 2, "guarded": true, "twins": [[0, 4], [1, 6]],
        "panels": [
            { "name": "front", "vertices": 4, "triangles": 2, "fabric": "wool" },
            { "name": HOSTILE, "vertices": 3, "triangles": 1, "fabric": "wool", "weft": weft },
        ],
        "bodies": [{ "name": "box", "vertices": 8, "triangles": 12 }],
    });
    fs::write(folder.path().join("surfaces.json"), format!("{manifest}\n")).unwrap();

    let (corners, faces) = cube();
    array(&folder.path().join("triangles.npy"), &[[0_u32, 2, 1], [1, 2, 3], [4, 6, 5]]);
    array(&folder.path().join("body-triangles.npy"), &faces);
    let front = [[0.0, 0.0], [0.1, 0.0], [0.0, 0.2], [0.1, 0.2]];
    array(
        &folder.path().join("material.npy"),
        &[&front[..], &[[0.0, 0.0], [0.5, 0.0], [0.0, 0.25]]].concat(),
    );
    array(&folder.path().join("bodies-00000.npy"), &corners);

    let mut list = "number,time,growth,bodies,touched\n".to_owned();
    let mut energy = "number,time,kinetic,gravity\n".to_owned();
    for (number, time) in times.iter().enumerate() {
        array(&folder.path().join(format!("frame-{number:05}.npy")), &cloth(*time));
        let touched = usize::from(number > 0);
        if touched > 0 {
            let mut pressures = [[f16::ZERO]; 7];
            pressures[2] = [f16::from_f64(pressure(number))];
            array(&folder.path().join(format!("pressure-{number:05}.npy")), &pressures);
        }
        list += &format!("{number},{time:?},1.0,0,{touched}\n");
        energy +=
            &format!("{number},{time:?},{},{}\n", 0.25 * (1 + number) as f64, -pressure(number));
    }
    fs::write(folder.path().join("energy.csv"), energy).unwrap();
    fs::write(folder.path().join("frames.csv"), list).unwrap();
    folder
}

/// Folder of a run with a frame every 0.1 s, in each of which the box has risen by one of `rises`,
/// in m. The frames of a box that rests share its file.
pub(crate) fn folder_of_rising_box(rises: &[f64]) -> TempDir {
    let times: Vec<f64> = (0..rises.len()).map(|k| 0.1 * k as f64).collect();
    let folder = folder(&times);
    let mut list = "number,time,growth,bodies,touched\n".to_owned();
    let mut file = 0;
    for (number, rise) in rises.iter().enumerate() {
        if number > 0 && *rise != rises[number - 1] {
            file = number;
            let risen: Vec<[f64; 3]> =
                cube().0.iter().map(|[x, y, z]| [*x, y + rise, *z]).collect();
            array(&folder.path().join(format!("bodies-{file:05}.npy")), &risen);
        }
        list += &format!("{number},{:?},1.0,{file},{}\n", times[number], usize::from(number > 0));
    }
    fs::write(folder.path().join("frames.csv"), list).unwrap();
    folder
}

/// Writes `rows` as an array to the file `path`.
pub(crate) fn array<T: npyz::AutoSerialize + Copy, const N: usize>(path: &Path, rows: &[[T; N]]) {
    let file = fs::File::create(path).unwrap();
    let shape = [rows.len() as u64, N as u64];
    let options = npyz::WriteOptions::new().default_dtype().shape(&shape);
    let mut writer = options.writer(file).begin_nd().unwrap();
    writer.extend(rows.iter().flatten().copied()).unwrap();
    writer.finish().unwrap();
}
