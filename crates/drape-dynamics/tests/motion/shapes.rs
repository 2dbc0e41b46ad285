//! Bodies that move or change their shape from frame to frame.

use std::fmt::Write;
use std::path::Path;

use drape_collide::{Body, Pose, Shape, Triangulation};
use drape_dynamics::Simulation;

use crate::sheet::{FLAT, Sheet, apart};

fn run(sheet: &Sheet) -> Simulation {
    let mut simulation = sheet.simulation();
    while !simulation.step().unwrap().finished {}
    simulation
}

fn sheet(scene: String) -> Sheet {
    Sheet { side: 0.2, scene, panel: FLAT.into(), ..Sheet::default() }
}

fn outline(shape: Shape, middle: [f64; 3]) -> Triangulation {
    Body::new("", shape, Pose::new(middle)).triangulate().unwrap()
}

fn obj(outline: &Triangulation) -> String {
    let mut text = String::new();
    outline.vertices.iter().for_each(|[x, y, z]| writeln!(text, "v {x:?} {y:?} {z:?}").unwrap());
    for [a, b, c] in &outline.triangles {
        writeln!(text, "f {} {} {}", a + 1, b + 1, c + 1).unwrap();
    }
    text
}

fn point_cache(samples: &[Vec<[f64; 3]>]) -> Vec<u8> {
    let mut bytes = b"POINTCACHE2\0".to_vec();
    bytes.extend(1_i32.to_le_bytes());
    bytes.extend((samples[0].len() as i32).to_le_bytes());
    bytes.extend(1_f32.to_le_bytes());
    bytes.extend(1_f32.to_le_bytes());
    bytes.extend((samples.len() as i32).to_le_bytes());
    bytes.extend(samples.iter().flatten().flatten().flat_map(|x| (*x as f32).to_le_bytes()));
    bytes
}

fn moved(outline: &Triangulation, displacement: [f64; 3]) -> Vec<[f64; 3]> {
    outline.vertices.iter().map(|x| [0, 1, 2].map(|axis| x[axis] + displacement[axis])).collect()
}

/// A block below the middle of the sheet, whose coordinates and displacement are fractions of two:
/// exact in 32 bits too.
fn block() -> (Triangulation, [f64; 3]) {
    let shape = Shape::Box { half_extents: [0.0625, 0.03125, 0.0625], edge_radius: 0.0 };
    (outline(shape, [0.0, -0.03515625, 0.0]), [0.0078125, 0.015625, 0.0])
}

fn scene(folder: &Path, motion: &str) -> String {
    let file = folder.join("block.obj");
    format!(
        "air.density = 0.0\ncontact.surfaces = true\nsolver.tolerance = 1e-4\n[time]\nstep = 0.002\nend = 0.1\n\
         [[collider.mesh]]\nfile = {:?}\nfriction = 0.3\n{motion}",
        file.display().to_string()
    )
}

#[test]
fn a_point_cache_moves_a_block_as_keys_do() {
    let folder = tempfile::tempdir().unwrap();
    let (block, [x, y, _]) = block();
    std::fs::write(folder.path().join("block.obj"), obj(&block)).unwrap();
    let samples = [0.0, 0.5, 1.0].map(|part| moved(&block, [part * x, part * y, 0.0]));
    let cache = folder.path().join("block.pc2");
    std::fs::write(&cache, point_cache(&samples)).unwrap();

    // An eighth of a second of keys after 16 ms; the cache has a frame every 1/16 s.
    let keys =
        format!("motion.times = [0.016, 0.141]\nmotion.shift = [[0, 0, 0], [{x}, {y}, 0]]\n");
    let by_keys = run(&sheet(scene(folder.path(), &keys)));
    let by_cache =
        format!("motion = {:?}\nrate = 16\nstart = 0.016\n", cache.display().to_string());
    let by_cache = run(&sheet(scene(folder.path(), &by_cache)));
    let (one, other) = (by_keys.energy().unwrap(), by_cache.energy().unwrap());
    assert!(one.work_in > 1e-4, "the block lifts the cloth: {one:?}");
    let difference = apart(&by_keys, &by_cache);
    println!("{difference:e} m apart, work {} and {}", one.work_in, other.work_in);
    assert!(difference < 1e-11, "{difference:e} m");
    assert!((one.work_in - other.work_in).abs() < 1e-9 * one.work_in);
    let bodies = |simulation: &Simulation| simulation.frame().bodies.into_flattened();
    let (one, other) = (bodies(&by_keys), bodies(&by_cache));
    let shifted = one.iter().zip(&other).fold(0.0_f64, |most, (a, b)| most.max((a - b).abs()));
    assert!(shifted < 1e-15 && one.len() == 24, "{shifted:e}");
    assert!((one[1] - block.vertices[0][1] - y * 0.084 / 0.125).abs() < 1e-12, "{}", one[1]);
}

#[test]
fn a_body_that_changes_its_shape_does_work_that_is_accounted_for() {
    let folder = tempfile::tempdir().unwrap();
    let ball = outline(Shape::Sphere { radius: 0.05 }, [0.0; 3]);
    for (number, [wide, high]) in [(8, [1.0, 1.0]), (9, [1.1, 1.2]), (10, [0.9, 1.5])] {
        let vertices =
            ball.vertices.iter().map(|[x, y, z]| [wide * x, high * y, z + 0.3 * (high - 1.0) * y]);
        let frame =
            Triangulation { vertices: vertices.collect(), triangles: ball.triangles.clone() };
        std::fs::write(folder.path().join(format!("ball {number}.obj")), obj(&frame)).unwrap();
    }
    std::fs::write(folder.path().join("block.obj"), obj(&ball)).unwrap();
    let frames = folder.path().join("ball *.obj").display().to_string();
    let motion = format!("frames = {frames:?}\nrate = 20\ncenter = [0, -0.0532, 0]\n");
    let simulation = run(&sheet(scene(folder.path(), &motion)));
    let energy = simulation.energy().unwrap();
    println!("{energy:?}");
    assert!(energy.work_in > 1e-4 && energy.body_dissipated > 0.0, "{energy:?}");
    assert!(energy.residual.abs() < 1e-6 * energy.work_in, "{energy:?}");
    let summary = simulation.summary();
    assert_eq!((summary.contact.intersections, summary.contact.intersections_found), (0, 0));
    // After the last frame, at 0.1 s, the ball is half as high again.
    let bodies = simulation.frame().bodies;
    let highest = bodies.iter().map(|x| x[1]).fold(f64::MIN, f64::max);
    assert!((highest - (0.075 - 0.0532)).abs() < 1e-9, "{highest}");
}

#[test]
fn motions_that_do_not_fit_are_refused_with_their_file() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, content: &[u8]| {
        std::fs::write(folder.path().join(name), content).unwrap();
    };
    let path = |name: &str| format!("{:?}", folder.path().join(name).display().to_string());
    let (block, _) = block();
    write("block.obj", obj(&block).as_bytes());
    let still = block.vertices.clone();
    write("short.pc2", &point_cache(&[still[1..].to_vec()]));
    write("cut.pc2", &point_cache(std::slice::from_ref(&still))[..100]);
    let mut flat = still.clone();
    flat[1] = flat[0];
    write("flat.pc2", &point_cache(&[still.clone(), flat]));
    let mut lost = still.clone();
    lost[3][1] = 2e6;
    write("lost.pc2", &point_cache(&[still.clone(), lost]));
    write("fast.pc2", &point_cache(&[still.clone(), moved(&block, [0.0, -20.0, 0.0])]));
    write("walk_1.obj", obj(&block).as_bytes());
    write("walk_3.obj", obj(&block).as_bytes());
    let mut fewer = block.clone();
    fewer.vertices.push([0.0; 3]);
    write("more_1.obj", obj(&fewer).as_bytes());
    let mut turned = block.clone();
    turned.triangles.reverse();
    write("other_1.obj", obj(&turned).as_bytes());
    let cases = [
        (
            format!("motion = {}\nrate = 24", path("short.pc2")),
            ["short.pc2 has 7 vertices", "has 8"],
        ),
        (
            format!("motion = {}\nrate = 24", path("cut.pc2")),
            ["cut.pc2", "96 bytes, and it has 68"],
        ),
        (format!("motion = {}\nrate = 24", path("none.pc2")), ["none.pc2", "check the path"]),
        (format!("motion = {}", path("short.pc2")), ["has no rate", "rate = 24"]),
        (format!("motion = {}\nrate = 24", path("flat.pc2")), ["frame 1", "has no area"]),
        (format!("motion = {}\nrate = 24", path("lost.pc2")), ["frame 1", "vertex 3 is at"]),
        (format!("motion = {}\nrate = 24", path("fast.pc2")), ["480.000 m/s", "slow it to"]),
        (format!("frames = {}\nrate = 24", path("walk_*.obj")), ["walk_*.obj", "number 2"]),
        (format!("frames = {}\nrate = 24", path("run_*.obj")), ["there is no file", "run_*.obj"]),
        (format!("frames = {}\nrate = 24", path("walk_1.obj")), ["walk_1.obj", "no *"]),
        (format!("frames = {}\nrate = 24", path("more_*.obj")), ["more_1.obj has 9", "has 8"]),
        (
            format!("frames = {}\nrate = 24", path("other_*.obj")),
            ["other_1.obj", "other triangles"],
        ),
        (format!("frames = {}\nrate = -1", path("walk_*.obj")), ["rate", "-1"]),
        ("rate = 24".to_owned(), ["no frames", "rate"]),
        ("motion = 3\nrate = 24".to_owned(), ["a table is needed", "a number"]),
    ];
    for (motion, words) in cases {
        let error = sheet(scene(folder.path(), &motion)).try_scene().expect_err(&motion);
        let message = error.to_string();
        for word in words {
            assert!(message.contains(word), "{word:?} is missing in: {message}");
        }
        assert!(message.contains("sheet.toml:"), "{message}");
    }
    let particles = scene(folder.path(), &format!("motion = {}\nrate = 24", path("short.pc2")));
    let particles = particles.replace("contact.surfaces = true", "contact.surfaces = false");
    let message = sheet(particles).try_scene().unwrap_err().to_string();
    assert!(message.contains("contact.surfaces = true"), "{message}");
}

#[test]
fn the_hash_of_a_scene_tells_its_bodies_apart() {
    let folder = tempfile::tempdir().unwrap();
    let (block, displacement) = block();
    let cache = folder.path().join("block.pc2");
    let motion = format!("motion = {:?}\nrate = 16\n", cache.display().to_string());
    let mut hashes = Vec::new();
    for (start, end) in [(0.0, 1.0), (0.0, 0.5), (-0.001, 0.5)] {
        let start = [0.0, start, 0.0];
        let mesh = Triangulation { vertices: moved(&block, start), ..block.clone() };
        std::fs::write(folder.path().join("block.obj"), obj(&mesh)).unwrap();
        let samples =
            [start, displacement.map(|x| end * x)].map(|displacement| moved(&block, displacement));
        std::fs::write(&cache, point_cache(&samples)).unwrap();
        hashes.push(sheet(scene(folder.path(), &motion)).scene().source.hash);
    }
    hashes.sort();
    hashes.dedup();
    assert_eq!(hashes.len(), 3);
}
