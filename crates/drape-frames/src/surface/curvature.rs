//! Curvature of a surface of triangles, from the normals at its vertices \[Rus04\].

use crate::error::Error;
use crate::surface::vector::{Vector, area_vector, cross, difference, dot, length, sum};

/// Returns the largest magnitude of a principal curvature of each of `triangles`, in 1/m, from the
/// `positions` of the vertices, in m. The curvature of a triangle without area is 0.
///
/// In the plane of a triangle the second fundamental form maps each edge to the difference of the
/// normals at its ends. The three edges give six equations for the three coefficients of the form.
/// The equations are solved by least squares \[Rus04\].
///
/// # Errors
/// [`Error::Corner`] if a corner is not an index of `positions`.
pub fn curvatures(positions: &[Vector], triangles: &[[u32; 3]]) -> Result<Vec<f64>, Error> {
    let exists = |corners: &[u32; 3]| corners.iter().all(|&c| (c as usize) < positions.len());
    if let Some(triangle) = triangles.iter().position(|corners| !exists(corners)) {
        return Err(Error::Corner { triangle, vertices: positions.len() });
    }

    let normals = normals(positions, triangles);
    let curvatures = triangles
        .iter()
        .map(|corners| {
            let corner_positions = corners.map(|corner| positions[corner as usize]);
            let corner_normals = corners.map(|corner| normals[corner as usize]);
            let curvature = triangle_curvature(corner_positions, corner_normals);
            if curvature.is_finite() { curvature } else { 0.0 }
        })
        .collect();
    Ok(curvatures)
}

/// Returns the largest magnitude of a principal curvature of the triangle with corners at
/// `positions` and unit `normals` at its corners. The result is not finite for a triangle without
/// area.
fn triangle_curvature(positions: [Vector; 3], normals: [Vector; 3]) -> f64 {
    let [first, second] = [1, 2].map(|k| difference(positions[k], positions[0]));
    let along = unit(first);
    let normal = unit(cross(first, second));
    let across = cross(normal, along);

    // Normal equations of the coefficients e, f, g: e u + f v = Δn·along, f u + g v = Δn·across.
    let (mut uu, mut uv, mut vv) = (0.0, 0.0, 0.0);
    let mut right = [0.0; 3];
    for k in 0..3 {
        let next = (k + 1) % 3;
        let edge = difference(positions[next], positions[k]);
        let turn = difference(normals[next], normals[k]);
        let [u, v] = [along, across].map(|axis| dot(edge, axis));
        let [p, q] = [along, across].map(|axis| dot(turn, axis));
        uu += u * u;
        uv += u * v;
        vv += v * v;
        right = [right[0] + u * p, right[1] + v * p + u * q, right[2] + v * q];
    }

    // The matrix is [[uu, uv, 0], [uv, uu + vv, uv], [0, uv, vv]].
    let determinant = uu * ((uu + vv) * vv - uv * uv) - uv * uv * vv;
    let [a, b, c] = right;
    let e = (a * ((uu + vv) * vv - uv * uv) - uv * (b * vv - uv * c)) / determinant;
    let f = (uu * (b * vv - c * uv) - a * uv * vv) / determinant;
    let g = (uu * ((uu + vv) * c - uv * b) - uv * (uv * c) + a * uv * uv) / determinant;

    let (mean, half) = (0.5 * (e + g), 0.5 * (e - g));
    mean.abs() + half.hypot(f)
}

/// Returns the unit normal at each vertex: the mean of the normals of the `triangles` around it,
/// weighted by their areas.
fn normals(positions: &[Vector], triangles: &[[u32; 3]]) -> Vec<Vector> {
    let mut normals = vec![[0.0; 3]; positions.len()];
    for corners in triangles {
        let area = area_vector(corners.map(|corner| positions[corner as usize]));
        for &corner in corners {
            let normal = &mut normals[corner as usize];
            *normal = sum(*normal, area);
        }
    }
    normals.into_iter().map(unit).collect()
}

/// Returns the unit vector in the direction of `vector`.
fn unit(vector: Vector) -> Vector {
    let length = length(vector);
    vector.map(|component| component / length)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the triangles of a grid with the given numbers of `columns` and `rows` of vertices.
    fn grid([columns, rows]: [u32; 2]) -> Vec<[u32; 3]> {
        let cells = (0..rows - 1).flat_map(|row| (0..columns - 1).map(move |column| [column, row]));
        let cell = |[column, row]: [u32; 2]| {
            let a = row * columns + column;
            [[a, a + 1, a + columns + 1], [a, a + columns + 1, a + columns]]
        };
        cells.flat_map(cell).collect()
    }

    #[test]
    fn cylinders_have_one_over_their_radius_whichever_way_they_lie() {
        let triangles = grid([40, 11]);
        // Axes of the cylinders along z, x and y.
        for (radius, turn, axis) in
            [(0.05, 0.0_f64, 0), (0.2, 0.7, 0), (0.2, 0.7, 1), (0.2, 0.7, 2)]
        {
            let place = |k: usize| {
                let [across, along] = [(k % 40) as f64, (k / 40) as f64].map(|n| 0.1 * radius * n);
                let (a, b) = (
                    across * turn.cos() - along * turn.sin(),
                    across * turn.sin() + along * turn.cos(),
                );
                let angle = a / radius;
                let mut place = [radius * angle.sin(), radius * angle.cos(), b];
                place.rotate_right(axis);
                place
            };
            let positions: Vec<Vector> = (0..440).map(place).collect();
            let found = curvatures(&positions, &triangles).expect("all vertices exist");
            // At the border a vertex has triangles on one side only, and its normal is less exact.
            let inner = (0..10).flat_map(|row| (2..37).map(move |column| 2 * (39 * row + column)));
            for triangle in inner.filter(|t| (2 * 39 * 2..2 * 39 * 8).contains(t)) {
                let error = found[triangle] * radius - 1.0;
                assert!(error.abs() < 0.03, "radius {radius}, axis {axis}: {error}");
            }
        }
    }

    #[test]
    fn a_sphere_and_a_plane() {
        let triangles = grid([21, 21]);
        let flat = |k: usize| [0.01 * (k % 21) as f64, 0.01 * (k / 21) as f64, 0.0];
        let positions: Vec<Vector> = (0..441).map(flat).collect();
        let found = curvatures(&positions, &triangles).expect("all vertices exist");
        assert!(found.iter().all(|value| value.abs() < 1e-12));
        let ball = |k: usize| unit([flat(k)[0] - 0.1, flat(k)[1] - 0.1, 0.5]).map(|c| 0.3 * c);
        let positions: Vec<Vector> = (0..441).map(ball).collect();
        let found = curvatures(&positions, &triangles).expect("all vertices exist");
        let middle = found[2 * (20 * 10 + 10)];
        assert!((middle * 0.3 - 1.0).abs() < 0.01, "{middle}");
    }

    #[test]
    fn a_corner_that_does_not_exist_is_named() {
        let error = Error::Corner { triangle: 1, vertices: 3 };
        assert_eq!(curvatures(&[[0.0; 3]; 3], &[[0, 1, 2], [0, 1, 3]]), Err(error));
    }

    #[test]
    fn a_triangle_without_area_has_none() {
        assert_eq!(curvatures(&[[0.0; 3]; 3], &[[0, 1, 2]]), Ok(vec![0.0]));
    }
}
