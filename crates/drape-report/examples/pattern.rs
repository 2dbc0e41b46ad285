//! Draws a cloth over a cube, as a formula has it, to look at the renderer's work.

#![allow(clippy::unwrap_used)]

use drape_report::{Scene, Surface, View, render};

fn main() {
    let n = 71;
    let size = 1.0;
    let (mut positions, mut coordinates, mut triangles) = (vec![], vec![], vec![]);
    for j in 0..n {
        for i in 0..n {
            let (u, v) = (
                size * i as f64 / (n - 1) as f64,
                size * j as f64 / (n - 1) as f64,
            );
            let (x, z) = (u - 0.5 * size, v - 0.5 * size);
            // Straight beyond the edges of the cube, folded at its corners.
            let (ox, oz) = ((x.abs() - 0.251).max(0.0), (z.abs() - 0.251).max(0.0));
            let out = ox.hypot(oz);
            let fold = if ox > 0.0 && oz > 0.0 {
                (2.0 * oz.atan2(ox)).sin()
            } else {
                0.0
            };
            let wave = 0.35 * out * fold * fold;
            let flare = if out > 0.0 {
                (0.09 * (1.0 - (-12.0 * out).exp()) + wave) / out
            } else {
                0.0
            };
            let px = x.clamp(-0.251, 0.251) + x.signum() * ox * flare;
            let pz = z.clamp(-0.251, 0.251) + z.signum() * oz * flare;
            positions.extend([px, 0.5015 - out * (1.0 - 0.1 * flare), pz]);
            coordinates.extend([u, v]);
        }
    }
    for j in 0..n - 1 {
        for i in 0..n - 1 {
            let (a, b) = ((j * n + i) as u32, ((j + 1) * n + i) as u32);
            triangles.extend([[a, b, b + 1], [a, b + 1, a + 1]]);
        }
    }
    let corner = |k: u32| [0, 1, 2].map(|a| if k >> a & 1 == 1 { 0.5 } else { 0.0 });
    let cube: Vec<f64> = (0..8)
        .flat_map(|k| {
            let [x, y, z] = corner(k);
            [x - 0.25, y, z - 0.25]
        })
        .collect();
    let faces = [
        [0, 4, 6, 2],
        [1, 3, 7, 5],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 2, 3, 1],
        [4, 5, 7, 6],
    ];
    let cube_triangles: Vec<[u32; 3]> = faces
        .iter()
        .flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]])
        .collect();
    let scene = Scene {
        cloths: vec![Surface::cloth(&positions, &triangles).with_lines(&coordinates, 0.04)],
        bodies: vec![Surface::body(&cube, &cube_triangles)],
        floor: Some(0.0),
    };
    let begin = std::time::Instant::now();
    let picture = render(
        &scene,
        &View {
            body_setback: 5e-3,
            ..View::default()
        },
    )
    .unwrap();
    println!("{:?}, {} triangles", begin.elapsed(), triangles.len());
    let path = std::env::args().nth(1).unwrap();
    picture.save(path).unwrap();
}
