//! A block on an inclined plane: Coulomb's law, by a backward Euler loop of its own.

#![allow(clippy::unwrap_used)]

use drape_collide::{Body, ParticleContact, ParticleSettings, Pose, Shape};

const GRAVITY: f64 = 9.81;
const AREA: f64 = 1e-2;
const MASS: f64 = 0.1;
const DT: f64 = 2e-3;

struct Block {
    contact: ParticleContact,
    position: [f64; 3],
    velocity: [f64; 3],
    angle: f64,
}

impl Block {
    /// At rest on a plane that falls towards +x at the angle.
    fn on_slope(angle: f64, friction: f64) -> Block {
        let pose = Pose::default().rotated([0.0, 0.0, 1.0], -angle);
        let plane = Body::new("slope", Shape::Plane, pose).with_friction(friction);
        let settings = ParticleSettings::default();
        let contact = ParticleContact::new(vec![plane], settings, vec![AREA]).unwrap();
        // The gap at which contact carries the block's weight.
        let gap = settings.activation_distance
            - MASS * GRAVITY * angle.cos() / (settings.stiffness * AREA);
        Block {
            contact,
            position: [gap * angle.sin(), gap * angle.cos(), 0.0],
            velocity: [0.0; 3],
            angle,
        }
    }

    /// One backward Euler step by Newton's method with the exact stiffness.
    fn step(&mut self) {
        self.contact.begin(&self.position, DT).unwrap();
        let start = self.position;
        let mut x = start;
        for _ in 0..60 {
            let mut residual = [0.0, -MASS * GRAVITY, 0.0];
            self.contact.add_forces(&x, &mut residual).unwrap();
            for k in 0..3 {
                residual[k] -= MASS / (DT * DT) * (x[k] - start[k] - DT * self.velocity[k]);
            }
            if residual.iter().all(|r| r.abs() < 1e-11) {
                break;
            }
            let mut matrix = [0.0; 9];
            self.contact
                .add_stiffness(&x, true, &mut |_, block| {
                    for k in 0..9 {
                        matrix[k] += block[k];
                    }
                })
                .unwrap();
            for k in 0..3 {
                matrix[4 * k] += MASS / (DT * DT);
            }
            let displacement = solve(matrix, residual);
            // Halve the step until the potential falls; friction is stiff where it turns over.
            let mut fraction = 1.0;
            let before = self.merit(x, start);
            loop {
                let trial = [0, 1, 2].map(|k| x[k] + fraction * displacement[k]);
                if self.merit(trial, start) <= before || fraction < 1e-6 {
                    x = trial;
                    break;
                }
                fraction *= 0.5;
            }
        }
        self.velocity = [0, 1, 2].map(|k| (x[k] - start[k]) / DT);
        self.position = x;
    }

    fn merit(&mut self, x: [f64; 3], start: [f64; 3]) -> f64 {
        let free = [0, 1, 2].map(|k| x[k] - start[k] - DT * self.velocity[k]);
        let inertia: f64 = free.iter().map(|d| 0.5 * MASS / (DT * DT) * d * d).sum();
        inertia + MASS * GRAVITY * (x[1] - start[1]) + self.contact.potential(&x).unwrap()
    }

    /// Way gone down the slope.
    fn descent(&self) -> f64 {
        self.position[0] * self.angle.cos() - self.position[1] * self.angle.sin()
    }
}

/// Cramer's rule.
fn solve(m: [f64; 9], b: [f64; 3]) -> [f64; 3] {
    let det = |c: [[f64; 3]; 3]| {
        c[0][0] * (c[1][1] * c[2][2] - c[1][2] * c[2][1])
            - c[1][0] * (c[0][1] * c[2][2] - c[0][2] * c[2][1])
            + c[2][0] * (c[0][1] * c[1][2] - c[0][2] * c[1][1])
    };
    let columns = [0, 1, 2].map(|j| [m[j], m[3 + j], m[6 + j]]);
    let whole = det(columns);
    [0, 1, 2].map(|j| {
        let mut replaced = columns;
        replaced[j] = b;
        det(replaced) / whole
    })
}

#[test]
fn below_the_friction_angle_a_block_stays() {
    let mut block = Block::on_slope(0.5f64.atan(), 0.55);
    for _ in 0..500 {
        block.step();
    }
    // Lagged friction holds by creeping below the slip speed of 1 mm/s; at 0.5/0.55 of the limit
    // f1 = 0.91, which is at 0.70 of it.
    let speed = block.descent() / (500.0 * DT);
    assert!((6e-4..8e-4).contains(&speed), "creeps at {speed} m/s");
    let gap = block.contact.summary(&block.position).unwrap().min_distance;
    assert!(gap > 0.9e-3, "sank to {gap} m");
}

#[test]
fn above_the_friction_angle_a_block_slides_as_coulomb_says() {
    for friction in [0.2, 0.45] {
        let angle = 0.5f64.atan();
        let mut block = Block::on_slope(angle, friction);
        let steps = 250;
        for _ in 0..steps {
            block.step();
        }
        let expected = GRAVITY * (angle.sin() - friction * angle.cos());
        let before = block.velocity;
        for _ in 0..steps {
            block.step();
        }
        let gained = [0, 1].map(|k| block.velocity[k] - before[k]);
        let measured = (gained[0] * angle.cos() - gained[1] * angle.sin()) / (steps as f64 * DT);
        let miss = (measured / expected - 1.0).abs();
        // At this speed the friction is Coulomb's to the last bit; the normal force has settled.
        assert!(miss < 1e-6, "mu {friction}: {measured} m/s², not {expected}");
    }
}

#[test]
fn without_friction_it_falls_along_the_slope_freely() {
    let angle = 0.3;
    let mut block = Block::on_slope(angle, 0.0);
    for _ in 0..500 {
        block.step();
    }
    let speed = block.velocity[0].hypot(block.velocity[1]);
    let expected = GRAVITY * angle.sin() * 500.0 * DT;
    let miss = (speed / expected - 1.0).abs();
    assert!(miss < 1e-9, "{speed} m/s, not {expected}");
}
