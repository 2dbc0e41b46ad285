//! A quadratic through the neighbourhood of a node, by least squares.

/// Nodes of a fit at most, its own among them.
pub(crate) const NODES: usize = 14;

/// Nodes of a fit at least, if there are as many: a quadratic has six numbers, and three more even it out.
const NODES_MIN: usize = 9;

/// Part of the largest eigenvalue of the quadratic's normal matrix that the smallest should have; more nodes are taken
/// until it has. Smaller values make noise of the positions larger, larger ones reach farther.
const EVEN: f64 = 0.04;

/// Part of the largest eigenvalue under which a curvature is not seen.
///
/// Where all nodes lie on two lines, the curvature across them is unknown; it is taken as none.
const SEEN: f64 = 1e-3;

/// Sweeps of the rotations that find eigenvalues of a 3 × 3 matrix: each squares what is left.
const SWEEPS: usize = 8;

/// Weights of the nearest nodes in the derivatives of what they carry, at the first of them.
///
/// With `$d$` the way from the first node over the spacing, the least of
/// `$\sum_k w_k\,(f(d_k) - f_k)^2$`, `$w = 1/(1 + d^2)$`, over quadratics `$f$`. The weights of the second derivatives
/// give nothing of linear functions, and both orders are exact for quadratics whose curvatures the nodes see.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Fit {
    /// Along weft and warp, in 1/m.
    pub(crate) slopes: [Vec<f64>; 2],
    /// Along weft and warp, in 1/m².
    pub(crate) bends: [Vec<f64>; 2],
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

impl Fit {
    /// The fit at the first of some places, in m, in the order in which they are taken; those of the first
    /// [`NODES_MIN`] must not all lie on a line. `spacing` is what the ways are counted in.
    pub(crate) fn new(places: &[[f64; 2]], spacing: f64) -> Self {
        let mut count = NODES_MIN.min(places.len());
        loop {
            let (fit, evenness) = Self::of(&places[..count], spacing);
            if evenness >= EVEN || count == places.len() {
                return fit;
            }
            count += 1;
        }
    }

    /// The fit, and the smallest over the largest eigenvalue of its normal matrix.
    fn of(places: &[[f64; 2]], spacing: f64) -> (Self, f64) {
        let ways: Vec<[f64; 2]> = places
            .iter()
            .map(|place| [0, 1].map(|k| (place[k] - places[0][k]) / spacing))
            .collect();
        let roots: Vec<f64> =
            ways.iter().map(|[u, v]| (1.0 / (1.0 + u * u + v * v)).sqrt()).collect();
        let column = |of: fn([f64; 2]) -> f64| -> Vec<f64> {
            ways.iter().zip(&roots).map(|(&way, root)| root * of(way)).collect()
        };
        // An orthonormal basis of the linear functions, and how 1, u, v are made of it.
        let mut basis: Vec<Vec<f64>> = Vec::new();
        let mut made = [[0.0; 3]; 3];
        for (k, of) in
            [|_: [f64; 2]| 1.0, |[u, _]: [f64; 2]| u, |[_, v]: [f64; 2]| v].into_iter().enumerate()
        {
            let mut rest = column(of);
            project(&mut rest, &basis, &mut made[k]);
            let length = dot(&rest, &rest).sqrt();
            made[k][k] = length;
            basis.push(rest.into_iter().map(|x| x / length).collect());
        }
        // Of the quadratics what no linear function gives; the factor of uv makes the three turn like a tensor.
        let quadratics = [
            |[u, _]: [f64; 2]| 0.5 * u * u,
            |[u, v]: [f64; 2]| std::f64::consts::FRAC_1_SQRT_2 * u * v,
            |[_, v]: [f64; 2]| 0.5 * v * v,
        ];
        let mut parts = [[0.0; 3]; 3];
        let mut rests = [const { Vec::new() }; 3];
        for (k, of) in quadratics.into_iter().enumerate() {
            let mut rest = column(of);
            project(&mut rest, &basis, &mut parts[k]);
            rests[k] = rest;
        }
        let normal = [0, 1, 2].map(|i| [0, 1, 2].map(|j| dot(&rests[i], &rests[j])));
        let (inverse, evenness) = inverted(normal);
        let seconds: [Vec<f64>; 3] = inverse.map(|row| {
            let entry =
                |node: usize| (0..3).map(|k| row[k] * rests[k][node]).sum::<f64>() * roots[node];
            (0..places.len()).map(entry).collect()
        });
        // The linear part of what the quadratics leave, in 1, u, v from the last on.
        let linear = |node: usize| -> [f64; 3] {
            let left = [0, 1, 2].map(|i| {
                let curved: f64 = (0..3).map(|k| parts[k][i] * seconds[k][node]).sum();
                basis[i][node] * roots[node] - curved
            });
            let v = left[2] / made[2][2];
            let u = (left[1] - made[2][1] * v) / made[1][1];
            [(left[0] - made[1][0] * u - made[2][0] * v) / made[0][0], u, v]
        };
        let slopes =
            [1, 2].map(|k| (0..places.len()).map(|node| linear(node)[k] / spacing).collect());
        let square = spacing * spacing;
        let [weft, _, warp] = seconds.map(|row| row.iter().map(|x| x / square).collect());
        (Self { slopes, bends: [weft, warp] }, evenness)
    }
}

/// Takes the parts along an orthonormal basis out of a column, twice for the sake of rounding, and adds them up.
fn project(column: &mut [f64], basis: &[Vec<f64>], parts: &mut [f64; 3]) {
    for _ in 0..2 {
        for (vector, part) in basis.iter().zip(parts.iter_mut()) {
            let along = dot(column, vector);
            *part += along;
            column.iter_mut().zip(vector).for_each(|(x, unit)| *x -= along * unit);
        }
    }
}

/// Inverse of a symmetric matrix on the eigenvectors whose eigenvalues are not too small, nothing on the others; and the
/// smallest over the largest eigenvalue.
fn inverted(mut matrix: [[f64; 3]; 3]) -> ([[f64; 3]; 3], f64) {
    let mut vectors = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    for _ in 0..SWEEPS {
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            if matrix[p][q] == 0.0 {
                continue;
            }
            let ratio = (matrix[q][q] - matrix[p][p]) / (2.0 * matrix[p][q]);
            let tangent = ratio.signum() / (ratio.abs() + (ratio * ratio + 1.0).sqrt());
            let cosine = 1.0 / (tangent * tangent + 1.0).sqrt();
            let sine = tangent * cosine;
            for row in &mut matrix {
                (row[p], row[q]) =
                    (cosine * row[p] - sine * row[q], sine * row[p] + cosine * row[q]);
            }
            let (first, second) = (matrix[p], matrix[q]);
            for k in 0..3 {
                matrix[p][k] = cosine * first[k] - sine * second[k];
                matrix[q][k] = sine * first[k] + cosine * second[k];
                let [a, b] = [vectors[p][k], vectors[q][k]];
                (vectors[p][k], vectors[q][k]) = (cosine * a - sine * b, sine * a + cosine * b);
            }
        }
    }
    let largest = (0..3).map(|k| matrix[k][k]).fold(0.0, f64::max);
    let smallest = (0..3).map(|k| matrix[k][k]).fold(largest, f64::min);
    let mut inverse = [[0.0; 3]; 3];
    for (k, vector) in vectors.iter().enumerate() {
        if matrix[k][k] > SEEN * largest {
            for i in 0..3 {
                for j in 0..3 {
                    inverse[i][j] += vector[i] * vector[j] / matrix[k][k];
                }
            }
        }
    }
    (inverse, if largest > 0.0 { smallest / largest } else { 0.0 })
}
