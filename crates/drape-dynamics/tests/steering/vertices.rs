//! Surface for a picture.

use crate::{EDGE, PARTICLES, simulation};

#[test]
fn vertices_are_positions_and_unit_normals_of_the_surface() {
    let mut simulation = simulation("", EDGE);
    for _ in 0..50 {
        simulation.step().unwrap();
    }
    let mut positions = vec![f32::NAN; 3 * PARTICLES];
    let mut normals = vec![f32::NAN; 3 * PARTICLES];
    simulation.write_vertices(&mut positions, &mut normals).unwrap();
    let pairs = positions.iter().zip(simulation.positions());
    assert!(pairs.into_iter().all(|(single, double)| *single == *double as f32));

    // The normals are near the mean of the normals of the triangles round each particle.
    let indices = simulation.triangle_indices();
    assert_eq!(indices.len(), 3 * simulation.triangles().len());
    let mut sums = vec![[0.0; 3]; PARTICLES];
    for corners in indices.chunks_exact(3) {
        let [a, b, c] = [0, 1, 2]
            .map(|k| corners[k] as usize)
            .map(|vertex| [0, 1, 2].map(|axis| f64::from(positions[3 * vertex + axis])));
        let (e, f) = ([0, 1, 2].map(|k| b[k] - a[k]), [0, 1, 2].map(|k| c[k] - a[k]));
        let cross: [f64; 3] = std::array::from_fn(|axis| {
            let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
            e[j] * f[k] - e[k] * f[j]
        });
        for &corner in corners {
            sums[corner as usize].iter_mut().zip(cross).for_each(|(sum, x)| *sum += x);
        }
    }
    for (sum, normal) in sums.iter().zip(normals.chunks_exact(3)) {
        let length = |v: &[f64]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
        let normal: Vec<f64> = normal.iter().map(|&x| f64::from(x)).collect();
        assert!((length(&normal) - 1.0).abs() < 1e-6);
        let cosine: f64 = sum.iter().zip(&normal).map(|(a, b)| a * b).sum::<f64>() / length(sum);
        assert!(cosine > 0.98, "{cosine}");
    }
}

#[test]
fn slices_of_another_length_are_refused_and_left_alone() {
    let simulation = simulation("", EDGE);
    for (positions, normals, words) in [
        (146, 147, "146 numbers for the positions"),
        (147, 0, "0 numbers for the normals"),
        (148, 147, "give a slice of 147"),
    ] {
        let (mut positions, mut normals) = (vec![7.0; positions], vec![7.0; normals]);
        let answer = simulation.write_vertices(&mut positions, &mut normals);
        let message = answer.unwrap_err().to_string();
        assert!(message.contains(words), "{message}");
        assert!(positions.iter().chain(&normals).all(|&x| x == 7.0));
    }
}
