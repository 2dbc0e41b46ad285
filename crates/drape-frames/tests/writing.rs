//! Frames in memory, and the writer of a folder.

#![allow(clippy::unwrap_used)]

use std::sync::Arc;

use drape_frames::{
    Error, Frame, FrameSource, FrameWriter, Manifest, Recording, SurfacePart, Topology,
    prepare_folder, write_summary,
};
use serde::Serialize;

#[derive(Serialize)]
struct Balance {
    kinetic: f64,
    lost: f64,
}

/// Returns a panel of three vertices above a body of four.
fn parts() -> (Manifest, Topology) {
    let front = SurfacePart {
        name: "front".to_owned(),
        vertices: 3,
        triangles: 1,
        half_activation_distance: 1e-3,
        half_min_separation: 1e-4,
        fabric: "wool".to_owned(),
        weft: [0.6, 0.8],
        fabric_colour: Some([0xb0, 0x3a, 0x2e]),
    };
    let stand = SurfacePart {
        name: "stand".to_owned(),
        vertices: 4,
        triangles: 2,
        ..SurfacePart::default()
    };
    let manifest = Manifest {
        surface_contact: true,
        panels: vec![front],
        bodies: vec![stand],
        pinch_fraction: 0.5,
        seam_pairs: vec![[0, 2]],
        ..Manifest::default()
    };
    let topology = Topology {
        material: vec![[0.0, 0.0], [0.1, 0.0], [0.0, 0.1]],
        cloth: vec![[0, 1, 2]],
        bodies: vec![[0, 1, 2], [0, 2, 3]],
    };
    (manifest, topology)
}

/// Returns five frames, at two of which the body moves, and the third of which has pressures.
fn frames() -> Vec<Frame> {
    let frame = |number: u32| {
        let time = 0.1 * f64::from(number);
        let height = if number < 2 { -1.0 } else { -0.9 };
        let pressures = (number == 2).then(|| vec![0.0, 1.5, 0.25]);
        Frame {
            time,
            growth_fraction: 0.5 + time,
            cloth: vec![[0.0, time, 0.0], [0.1, time, 1.0 / 3.0], [0.0, time, -1e-9]],
            bodies: vec![[0.0, height, 0.0]; 4],
            pressures,
            ..Frame::default()
        }
    };
    (0..5).map(frame).collect()
}

#[test]
fn a_folder_and_memory_give_the_same_frames() {
    let (manifest, topology) = parts();
    let folder = tempfile::tempdir().unwrap();
    prepare_folder(folder.path(), false).unwrap();
    let mut writer = FrameWriter::create(folder.path(), &manifest, &topology).unwrap();
    for (number, frame) in (0..).zip(&frames()) {
        let balance = Balance { kinetic: f64::from(number), lost: 0.1 };
        writer.write_with_energy(frame, (number > 1).then_some(&balance)).unwrap();
    }
    write_summary(folder.path(), &serde_json::json!({ "frames": 5 })).unwrap();

    let stored = Recording::open(folder.path()).unwrap();
    let kept = Recording::of_frames(manifest.clone(), topology.clone(), frames()).unwrap();
    for recording in [&stored, &kept] {
        assert_eq!((recording.manifest(), recording.topology()), (&manifest, &topology));
        assert!(recording.ended() && recording.has_pressures());
        let firsts = (0..5).map(|number| recording.frame(number).unwrap().bodies_frame);
        assert_eq!(firsts.collect::<Vec<_>>(), [0, 0, 2, 2, 2].map(Some));
    }
    for number in 0..5 {
        let (stored, kept) = (stored.frame(number).unwrap(), kept.frame(number).unwrap());
        assert!(stored.file.is_some() && kept.file.is_none());
        assert_eq!(Frame { file: None, ..stored }, kept, "frame {number}");
    }
    let energy = stored.energy().unwrap().unwrap();
    assert_eq!(energy.names, ["kinetic", "lost"]);
    assert_eq!(energy.rows[1..3], [None, Some(vec![2.0, 0.1])]);
    assert_eq!((kept.folder(), kept.energy().unwrap()), (None, None));
}

#[test]
fn a_writer_resumes_after_the_frames_that_were_saved() {
    let (manifest, topology) = parts();
    let folder = tempfile::tempdir().unwrap();
    let mut writer = FrameWriter::create(folder.path(), &manifest, &topology).unwrap();
    let saved: Vec<_> = frames()
        .iter()
        .map(|frame| {
            writer.write(frame).unwrap();
            writer.save().unwrap()
        })
        .collect();
    drop(writer);

    // The frames after the third are written again, with other positions.
    let mut writer = FrameWriter::resume(folder.path(), &manifest, saved[2].clone()).unwrap();
    assert_eq!(Recording::open(folder.path()).unwrap().frame_count(), 3);
    let late = Frame { time: 0.7, ..frames()[1].clone() };
    writer.write(&late).unwrap();
    let recording = Recording::open(folder.path()).unwrap();
    assert_eq!((recording.frame_count(), recording.time(3).unwrap()), (4, 0.7));
    assert_eq!(recording.frame(3).unwrap().bodies_frame, Some(3));

    // A state that counts more frames than there are is of another run.
    let error = FrameWriter::resume(folder.path(), &manifest, saved[4].clone()).unwrap_err();
    assert!(matches!(error, Error::LostFrames { found: 4, frames: 5, .. }), "{error}");
    let occupied = prepare_folder(folder.path(), false).unwrap_err();
    assert!(matches!(occupied, Error::Occupied { .. }), "{occupied}");
    std::fs::write(folder.path().join("notes.txt"), "mine").unwrap();
    prepare_folder(folder.path(), true).unwrap();
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1, "only the notes stay");
}

#[test]
fn frames_that_do_not_fit_are_refused_by_memory_and_writer_alike() {
    let (manifest, topology) = parts();
    let good = frames()[0].clone();
    let bad = [
        Frame { cloth: Vec::new(), ..good.clone() },
        Frame { bodies: good.bodies[1..].to_vec(), ..good.clone() },
        Frame { cloth: vec![[f64::NAN, 0.0, 0.0]; 3], ..good.clone() },
        Frame { bodies: vec![[0.0, f64::INFINITY, 0.0]; 4], ..good.clone() },
        Frame { cloth: vec![[0.0, 1e7, 0.0]; 3], ..good.clone() },
        Frame { pressures: Some(vec![1.0]), ..good.clone() },
        Frame { pressures: Some(vec![0.0, -1.0, 0.0]), ..good.clone() },
        Frame { growth_fraction: 0.0, ..good.clone() },
        Frame { growth_fraction: f64::NAN, ..good.clone() },
        Frame { time: f64::NAN, ..good.clone() },
        Frame { time: -0.5, ..good.clone() },
    ];
    for frame in bad {
        let folder = tempfile::tempdir().unwrap();
        let mut writer = FrameWriter::create(folder.path(), &manifest, &topology).unwrap();
        writer.write(&good).unwrap();
        let error = writer.write(&frame).unwrap_err();
        assert!(matches!(error, Error::BadFrame { .. }), "{error}");
        assert_eq!(Recording::open(folder.path()).unwrap().frame_count(), 1);
        let frames = vec![good.clone(), frame];
        let error = Recording::of_frames(manifest.clone(), topology.clone(), frames).unwrap_err();
        assert!(matches!(error, Error::BadFrame { number: 1, .. }), "{error}");
    }
    let error = Recording::of_frames(manifest, topology, Vec::new()).unwrap_err();
    assert!(matches!(error, Error::BadFrame { number: 0, .. }), "{error}");
}

#[test]
fn parts_and_triangles_that_do_not_fit_are_refused() {
    let (manifest, topology) = parts();
    let changed_topology = |change: fn(&mut Topology)| {
        let mut changed = topology.clone();
        change(&mut changed);
        Recording::of_frames(manifest.clone(), changed, frames()).unwrap_err()
    };
    let topologies: [fn(&mut Topology); 5] = [
        |topology| topology.material.truncate(2),
        |topology| topology.material[0][1] = f64::NAN,
        |topology| topology.cloth.clear(),
        |topology| topology.cloth[0] = [0, 1, 1],
        |topology| topology.bodies[1] = [0, 1, 4],
    ];
    for change in topologies {
        let error = changed_topology(change);
        let is_named = matches!(error, Error::BadTopology { .. } | Error::BadTriangle { .. });
        assert!(is_named, "{error}");
    }
    let manifests: [fn(&mut Manifest); 6] = [
        |manifest| manifest.panels[0].weft = [0.0, 0.0],
        |manifest| manifest.panels[0].half_activation_distance = f64::NAN,
        |manifest| manifest.panels[0].vertices = usize::MAX,
        |manifest| manifest.pinch_fraction = 2.0,
        |manifest| manifest.seam_pairs = vec![[0, 3]],
        |manifest| manifest.ties = vec![[0, 1, u32::MAX]],
    ];
    for change in manifests {
        let mut changed = manifest.clone();
        change(&mut changed);
        let folder = tempfile::tempdir().unwrap();
        FrameWriter::create(folder.path(), &changed, &topology).unwrap_err();
    }
}

/// Source whose frames are computed on request.
#[derive(Debug)]
struct Falling;

impl FrameSource for Falling {
    fn frame_count(&self) -> usize {
        4
    }

    fn time(&self, number: usize) -> f64 {
        0.25 * number as f64
    }

    fn frame(&self, number: usize) -> Result<Frame, Error> {
        let time = self.time(number);
        Ok(Frame { number, time, cloth: vec![[0.0, -time, 0.0]; 3], ..Frame::default() })
    }
}

#[test]
fn a_program_may_compute_its_frames_on_request() {
    let (manifest, topology) = parts();
    let manifest = Manifest { bodies: Vec::new(), ..manifest };
    let topology = Topology { bodies: Vec::new(), ..topology };
    let other = Manifest { panels: vec![manifest.panels[0].clone(); 2], ..manifest.clone() };
    let wide = Topology {
        material: topology.material.repeat(2),
        cloth: vec![[0, 1, 2], [3, 4, 5]],
        ..topology.clone()
    };
    let misfit = Recording::of_source(other, wide, Arc::new(Falling)).unwrap();
    assert!(matches!(misfit.frame(1), Err(Error::BadFrame { number: 1, .. })));

    let recording = Recording::of_source(manifest, topology, Arc::new(Falling)).unwrap();
    assert_eq!(recording.frame(3).unwrap().cloth[0], [0.0, -0.75, 0.0]);
    let error = recording.frame(4).unwrap_err();
    assert_eq!(error.to_string(), "the recording has no frame 4; its frames are 0 to 3");
}
