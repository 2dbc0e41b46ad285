//! Spheres with bumps, as a program might have them in its own lists.

use std::f64::consts::{PI, TAU};

use crate::SHIFT;

/// Closed mesh: a sphere of about 1 m with bumps.
pub struct BumpySphere {
    pub positions: Vec<[f64; 3]>,
    pub triangles: Vec<[u32; 3]>,
}

impl BumpySphere {
    /// Returns a sphere about `center`, in m, of `rings` rings of triangles. `phase` shifts the
    /// bumps.
    pub fn new(rings: u32, phase: f64, center: [f64; 3]) -> Self {
        let around = 2 * rings;
        let place = |polar: f64, azimuth: f64| {
            let bump = (5.0 * azimuth + phase).sin() * (4.0 * polar - phase).cos();
            let radius = 1.0 + 0.08 * bump * polar.sin();
            let (sine, cosine) = polar.sin_cos();
            let direction = [sine * azimuth.cos(), cosine, sine * azimuth.sin()];
            [0, 1, 2].map(|k| center[k] + radius * direction[k])
        };
        let ring = |number: u32| {
            let polar = PI * f64::from(number) / f64::from(rings);
            (0..around).map(move |k| place(polar, TAU * f64::from(k) / f64::from(around)))
        };
        let poles = [place(0.0, 0.0), place(PI, 0.0)];
        let positions = (1..rings).flat_map(ring).chain(poles).collect();

        // The two poles are the last vertices.
        let [top, bottom] = [(rings - 1) * around, (rings - 1) * around + 1];
        let mut triangles = Vec::new();
        for k in 0..around {
            let next = (k + 1) % around;
            let last = (rings - 2) * around;
            triangles.extend([[top, next, k], [bottom, last + k, last + next]]);
            for first in (0..rings - 2).map(|ring| ring * around) {
                let [a, b, c, d] = [k, next, around + next, around + k].map(|v| first + v);
                triangles.extend([[a, b, c], [a, c, d]]);
            }
        }
        Self { positions, triangles }
    }

    /// Returns the positions after a `fraction` of the shift, in m.
    pub fn shifted(&self, fraction: f64) -> Vec<[f64; 3]> {
        let shift = |x: &[f64; 3]| [0, 1, 2].map(|k| x[k] + fraction * SHIFT[k]);
        self.positions.iter().map(shift).collect()
    }
}
