//! In steady state contact allocates nothing.
//!
//! One thread runs all: with more, rayon allocates blocks for its queues of jobs now and then,
//! which is not of this crate. Values that are handed out (`memory`, `ParticleContact::summary`,
//! `is_inside_body`) are allocated where they are made, and are not measured here.

#![allow(clippy::unwrap_used)]

#[expect(dead_code)]
#[path = "surface/sheets.rs"]
mod sheets;
mod support;

use drape_collide::{
    Mesh, ParticleContact, ParticleSettings, PinchPolicy, Pose, Shape, SurfaceContact,
    SurfaceMemory, SurfaceSettings, SurfaceStart, SurfaceTrial,
};
use rayon::ThreadPoolBuilder;

/// Steps before allocations are counted.
const FIRST: usize = 8;

/// Steps in which they are counted.
const COUNTED: usize = 40;

/// Runs a closure with the number of each step, and returns the allocations of the later ones.
fn allocations(mut step: impl FnMut(usize) + Send) -> u64 {
    let pool = ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    pool.install(|| {
        (0..FIRST).for_each(&mut step);
        allocation_counter::measure(|| (FIRST..FIRST + COUNTED).for_each(&mut step)).count_total
    })
}

/// Two sheets, of which the lower one belongs to a body that swings to and fro under the upper one.
fn swinging(pinch: PinchPolicy) -> u64 {
    let (side, spacing) = (20, 5e-3);
    let mut parts = sheets::sheets(2, side, spacing);
    parts.free_vertices = side * side;
    let rest = parts.rest_positions[3 * parts.free_vertices..].to_vec();
    let settings = SurfaceSettings {
        stiffness: 1e8,
        sticking_displacement: SurfaceSettings::STICKING_DISPLACEMENT,
        friction_coefficients: vec![0.3; 4],
        pinch,
    };
    let surface = sheets::surface(&parts);
    let mut contact = SurfaceContact::new(surface, settings, rest.clone()).unwrap();
    let above = |height: f64| {
        rest.iter().enumerate().map(move |(k, x)| x + height * [0.0, 0.0, 1.0][k % 3])
    };
    let (start, mut end) = (above(4e-4).collect::<Vec<f64>>(), rest.clone());
    let (mut forces, mut displacements) = (start.clone(), start.clone());
    let mut memory = SurfaceMemory::default();
    allocations(|step| {
        let swing = if step % 2 == 0 { 1e-4 } else { 0.0 };
        end.iter_mut().zip(above(swing)).for_each(|(end, x)| *end = x);
        contact.state().save(&mut memory);
        contact.begin(SurfaceStart::new(&start, &end)).unwrap();
        let mut open_step = contact.step().unwrap();
        open_step.set_obstacle_time(0.0);
        for trial in 0..3 {
            let down = |k: usize| if k % 3 == 2 { -1e-2 * f64::from(trial) } else { 0.0 };
            displacements.iter_mut().enumerate().for_each(|(k, dx)| *dx = down(k));
            let whole = open_step
                .limit(SurfaceTrial {
                    start: &start,
                    displacements: &mut displacements,
                    held: &[0],
                    obstacle_time: 0.0,
                    obstacle_advance: &mut 1.0,
                })
                .unwrap();
            assert!(trial == 0 || !whole);
            forces.fill(0.0);
            open_step.energy(&start).unwrap().add_forces(&mut forces).unwrap();
            let energy = open_step.energy(&start).unwrap().potential()
                + open_step.body_work(&start).unwrap();
            let mut blocks = 0;
            open_step.energy(&start).unwrap().add_stiffness(&mut |_, _| blocks += 1);
            assert!(energy.is_finite() && blocks > 100, "{energy} J, {blocks} blocks");
        }
        open_step.set_obstacle_time(1.0);
        assert!(open_step.intersections(&start).unwrap().is_empty());
        open_step.commit(&start).unwrap();
        if step % 3 == 0 {
            contact.restore(&memory).unwrap();
        }
    })
}

#[test]
fn steps_of_surfaces_allocate_nothing() {
    for pinch in [PinchPolicy::Error, PinchPolicy::Thin, PinchPolicy::Release] {
        assert_eq!(swinging(pinch), 0, "{pinch:?}");
    }
}

#[test]
fn steps_of_particles_allocate_nothing() {
    let mesh: Mesh = support::meshed(Shape::Sphere { radius: 0.1 });
    let bodies = [Shape::Sphere { radius: 0.1 }, Shape::Mesh(mesh)]
        .map(|shape| drape_collide::Body::new("ball", shape, Pose::default()).with_friction(0.3));
    for body in bodies {
        let direction = |k: usize| {
            let angle = k as f64 * 0.01;
            [angle.sin(), angle.cos(), 0.0]
        };
        let settings = ParticleSettings::default();
        let mut contact = ParticleContact::new(vec![body], settings, vec![1e-4; 600]).unwrap();
        let mut positions = vec![0.0; 1800];
        let mut forces = positions.clone();
        let counted = allocations(|step| {
            let radius = 0.1004 + 1e-5 * (step % 3) as f64;
            for (k, place) in positions.chunks_exact_mut(3).enumerate() {
                place.copy_from_slice(&direction(k).map(|x| radius * x));
            }
            contact.begin(&positions, 1e-2).unwrap();
            contact.move_body(0, Pose::new([0.0, 1e-6 * (step % 2) as f64, 0.0])).unwrap();
            contact.add_forces(&positions, &mut forces).unwrap();
            assert!(contact.potential(&positions).unwrap() > 0.0);
            contact.add_stiffness(&positions, true, &mut |_, _| ()).unwrap();
            assert!(contact.touching_particle_count(&positions).unwrap() > 500);
        });
        assert_eq!(counted, 0);
    }
}
