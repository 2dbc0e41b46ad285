//! Bad input through every entry of contact: typed errors, no panic, and nothing changed.

#![allow(clippy::unwrap_used)]

use drape_collide::{
    Body, ContactDistances, Detector, Error, Gap, ParticleContact, ParticleSettings, PlainMesh,
    Pose, Shape, Surface, SurfaceContact, SurfaceMemory, SurfaceParts, SurfaceSettings,
    SurfaceStart, SurfaceTrial, equivalence_classes,
};

const DISTANCES: ContactDistances =
    ContactDistances { activation_distance: 3e-4, min_separation: 1e-4 };
const CLOTH: [[f64; 3]; 3] = [[0.0, 5e-4, 0.0], [0.0, 5e-4, 0.01], [0.01, 5e-4, 0.0]];
const FLOOR: [[f64; 3]; 3] = [[-1.0, 0.0, -1.0], [-1.0, 0.0, 1.0], [1.0, 0.0, 0.0]];

fn parts() -> SurfaceParts {
    let mesh = |positions| PlainMesh { positions, triangles: &[[0, 1, 2]] };
    SurfaceParts::from_meshes(&[mesh(&CLOTH)], &[mesh(&FLOOR)], DISTANCES).unwrap()
}

fn surface_contact() -> SurfaceContact {
    let settings = SurfaceSettings::new(1e8, vec![0.3; 4]);
    SurfaceContact::new(Surface::new(parts()).unwrap(), settings, FLOOR.concat()).unwrap()
}

fn is_length(error: &Error) -> bool {
    matches!(error, Error::WrongLength { .. })
}

#[test]
fn a_surface_without_a_free_vertex_is_refused_with_a_remedy() {
    let refused = Surface::new(SurfaceParts { free_vertices: 0, ..parts() }).unwrap_err();
    assert_eq!(refused, Error::NothingFree { vertices: 6 });
    assert!(refused.to_string().contains("`free_vertices`"), "{refused}");

    // The remedy: two free meshes meet, and two bodies do not.
    let mesh = |positions| PlainMesh { positions, triangles: &[[0, 1, 2]] };
    let meshes = [mesh(&CLOTH), mesh(&FLOOR)];
    let positions = [CLOTH, FLOOR].concat().concat();
    let pairs = |parts: SurfaceParts, positions: &[f64]| {
        let surface = Surface::new(parts).unwrap();
        Detector::default().detect(&surface, positions, 1e-4).unwrap().as_slice().len()
    };
    let free = SurfaceParts::from_meshes(&meshes, &[], DISTANCES).unwrap();
    assert!(pairs(free, &positions) >= 3);
    let away = [[9.0, 9.0, 9.0]];
    let point = PlainMesh { positions: &away, triangles: &[] };
    let bodies = SurfaceParts::from_meshes(&[point], &meshes, DISTANCES).unwrap();
    assert_eq!(pairs(bodies, &[&away[0][..], &positions].concat()), 0);
}

#[test]
fn particles_refuse_short_lists_and_missing_bodies() {
    let table = Body::new("table", Shape::Plane, Pose::default());
    let settings = ParticleSettings::default();
    let mut contact = ParticleContact::new(vec![table.clone()], settings, vec![1e-4; 2]).unwrap();
    let start = [0.0, 5e-4, 0.0, 1.0, 5e-4, 0.0];
    contact.begin(&start, 0.01).unwrap();
    let before = contact.potential(&start).unwrap();

    for short in [&start[..5], &start[..3], &[]] {
        assert!(is_length(&contact.begin(short, 0.01).unwrap_err()));
        assert!(is_length(&contact.potential(short).unwrap_err()));
        assert!(is_length(&contact.friction_potential(short).unwrap_err()));
        assert!(is_length(&contact.body_friction_work(short).unwrap_err()));
        assert!(is_length(&contact.touching_particle_count(short).unwrap_err()));
        assert!(is_length(&contact.summary(short).unwrap_err()));
        assert!(is_length(&contact.add_forces(short, &mut [0.0; 6]).unwrap_err()));
        assert!(is_length(&contact.add_forces(&start, &mut [0.0; 5]).unwrap_err()));
        let stiffness = contact.add_stiffness(short, true, &mut |_, _| panic!("no block"));
        assert!(is_length(&stiffness.unwrap_err()));
    }
    let missing = contact.move_body(9, Pose::default()).unwrap_err();
    assert_eq!(missing, Error::MissingIndex { what: "body", index: 9, count: 1 });
    let lost = contact.move_body(0, Pose::new([f64::NAN, 0.0, 0.0])).unwrap_err();
    assert!(matches!(lost, Error::InvalidPosition { .. }), "{lost}");
    assert_eq!(contact.bodies()[0].pose, table.pose, "the body stays where it is");
    assert!(contact.begin(&start, f64::NAN).is_err());
    assert_eq!(contact.potential(&start).unwrap(), before);

    for friction in [-0.1, f64::NAN, f64::INFINITY] {
        let body = table.clone().with_friction(friction);
        assert!(ParticleContact::new(vec![body], settings, vec![1e-4]).is_err(), "{friction}");
    }
    for bad in [0.0, -1.0, f64::NAN] {
        let settings = ParticleSettings { activation_distance: bad, ..settings };
        assert!(ParticleContact::new(vec![table.clone()], settings, vec![1e-4]).is_err(), "{bad}");
    }
    // A position that is not finite is a trial that no line search accepts.
    let lost = [f64::NAN, 0.0, 0.0, 1.0, 0.0, 0.0];
    assert!(contact.potential(&lost).unwrap().is_nan());
}

#[test]
fn surfaces_refuse_short_lists_and_missing_vertices_and_stay_usable() {
    let mut contact = surface_contact();
    let (cloth, floor) = (CLOTH.concat(), FLOOR.concat());
    for short in [&cloth[..8], &cloth[..6], &[]] {
        assert!(is_length(&contact.begin(SurfaceStart::new(short, &floor)).unwrap_err()));
        assert!(is_length(&contact.begin(SurfaceStart::new(&cloth, &floor[1..])).unwrap_err()));
        assert_eq!(contact.step().unwrap_err(), Error::NoOpenStep);
        assert!(is_length(&contact.energy(short).unwrap_err()));
        assert!(is_length(&contact.detect(short).unwrap_err()));
        assert!(is_length(&contact.intersections(short).unwrap_err()));
        assert!(is_length(&contact.inspect(short).unwrap_err()));
        let mut setup = contact.setup().unwrap();
        assert!(is_length(&setup.open_seams(&[0.0; 2], &cloth).unwrap_err()));
        assert!(is_length(&setup.place_bodies(short).unwrap_err()) || short.len() == 9);
    }
    let gaps = SurfaceStart { seam_gaps: Some(&[0.0; 4]), ..SurfaceStart::new(&cloth, &floor) };
    assert!(is_length(&contact.begin(gaps).unwrap_err()));
    let mut lost = floor.clone();
    lost[0] = f64::INFINITY;
    assert!(contact.setup().unwrap().place_bodies(&lost).is_err());
    assert!(contact.inspect(&cloth).unwrap().is_inside_body(3).is_err());
    assert!(contact.restore(&SurfaceMemory::default()).is_err());
    assert_eq!(
        contact.surface().group(99).unwrap_err(),
        Error::MissingIndex { what: "vertex", index: 99, count: 6 }
    );
    assert!(contact.surface().pair_distances(0, 6).is_err());
    assert_eq!(contact.surface().group(5).unwrap(), 1);

    let mut step = contact.begin(SurfaceStart::new(&cloth, &floor)).unwrap();
    let energy = step.energy(&cloth).unwrap().potential();
    assert!(energy > 0.0, "{energy}");
    assert!(is_length(&step.energy(&cloth).unwrap().add_forces(&mut [0.0; 8]).unwrap_err()));
    assert!(is_length(&step.body_work(&cloth[3..]).unwrap_err()));
    let mut limit = |start: &[f64], moved: &mut [f64], held: &[usize]| {
        step.limit(SurfaceTrial {
            start,
            displacements: moved,
            held,
            obstacle_time: 0.0,
            obstacle_advance: &mut 1.0,
        })
    };
    assert!(is_length(&limit(&cloth[1..], &mut [0.0; 9], &[]).unwrap_err()));
    assert!(is_length(&limit(&cloth, &mut [0.0; 10], &[]).unwrap_err()));
    let held = limit(&cloth, &mut [0.0; 9], &[3]).unwrap_err();
    assert_eq!(held, Error::MissingIndex { what: "free vertex", index: 3, count: 3 });
    // Where a displacement is not finite, nothing moves.
    let mut endless = [f64::NAN; 9];
    assert_eq!((limit(&cloth, &mut endless, &[]), endless), (Ok(false), [0.0; 9]));

    // A commit that is refused leaves the step open.
    assert!(is_length(&step.commit(&cloth[..6]).unwrap_err()));
    assert!(contact.step().unwrap().commit(&[f64::NAN; 9]).is_err());
    assert_eq!(contact.step().unwrap().energy(&cloth).unwrap().potential(), energy);
    contact.step().unwrap().commit(&cloth).unwrap();
}

#[test]
fn pairs_and_classes_refuse_numbers_that_do_not_exist() {
    let surface = Surface::new(parts()).unwrap();
    let positions = [CLOTH, FLOOR].concat().concat();
    let mut detector = Detector::default();
    for margin in [0.0, -1e-4, f64::NAN, f64::INFINITY] {
        let refused = detector.detect(&surface, &positions, margin).unwrap_err();
        assert!(matches!(refused, Error::OutOfRange { .. }), "{refused}");
    }
    let pair = detector.detect(&surface, &positions, 1e-4).unwrap().as_slice()[0];
    for short in [&positions[..9], &[]] {
        assert!(matches!(Gap::new(&pair, short).unwrap_err(), Error::MissingIndex { .. }));
        assert!(matches!(pair.distance_at(short).unwrap_err(), Error::MissingIndex { .. }));
    }
    let missing = equivalence_classes(3, &[[0, 1], [2, 3]]).unwrap_err();
    assert_eq!(missing, Error::MissingIndex { what: "vertex", index: 3, count: 3 });
    assert_eq!(equivalence_classes(4, &[[0, 1], [2, 3]]).unwrap(), [0, 0, 2, 2]);
    let mesh = PlainMesh { positions: &CLOTH, triangles: &[[0, 1, 3]] };
    let missing = SurfaceParts::from_meshes(&[mesh], &[], DISTANCES).unwrap_err();
    assert!(matches!(missing, Error::MissingVertex { index: 3, .. }), "{missing}");
    for coefficient in [-0.1, f64::NAN] {
        let settings = SurfaceSettings::new(1e8, vec![coefficient; 4]);
        let surface = Surface::new(parts()).unwrap();
        assert!(SurfaceContact::new(surface, settings, FLOOR.concat()).is_err(), "{coefficient}");
    }
}
