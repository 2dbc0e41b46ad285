//! Quadratic fitted to the neighbourhood of a node by least squares. Its derivatives are the
//! weights of a stencil.

/// Largest number of nodes of a fit, including its first node.
pub(crate) const NODES: usize = 14;

/// Least number of nodes of a fit, if there are as many. A quadratic has six coefficients, and
/// three more nodes average it.
const NODES_MIN: usize = 9;

/// Least ratio of the smallest to the largest eigenvalue of the normal matrix of the quadratic
/// terms. Nodes are added until it is reached. Smaller values amplify noise of the positions,
/// larger ones need more distant nodes.
const CONDITION_MIN: f64 = 0.04;

/// Ratio to the largest eigenvalue below which a curvature is undetermined.
///
/// Where all nodes lie on two lines, the curvature across them is unknown. It is taken as zero.
const DETERMINED_MIN: f64 = 1e-3;

/// Number of Jacobi sweeps for the eigenvalues of a 3 × 3 matrix. Each sweep squares the error.
const SWEEPS: usize = 8;

/// Weights of the nearest nodes in the derivatives of a quantity at the first node.
///
/// With the vector `$d_k$` from the first node over the spacing, the quadratic `$f$` minimises
///
/// ```math
/// \sum_k w_k\,\left(f(d_k) - f_k\right)^2,\qquad w_k = \frac{1}{1 + d_k^2}
/// ```
///
/// The weights of the second derivatives are zero on linear functions. Both orders are exact for
/// quadratics whose curvatures the nodes determine.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct QuadraticFit {
    /// Weights of the first derivatives along weft and warp, in 1/m.
    pub(crate) first: [Vec<f64>; 2],
    /// Weights of the second derivatives along weft and warp, in 1/m².
    pub(crate) second: [Vec<f64>; 2],
}

/// A fit and its conditioning: the ratio of the smallest to the largest eigenvalue of the normal
/// matrix.
struct ConditionedFit {
    fit: QuadraticFit,
    condition: f64,
}

/// Inverse of a symmetric matrix on its determined eigenvectors, and the conditioning of the
/// matrix.
struct ConditionedInverse {
    inverse: [[f64; 3]; 3],
    condition: f64,
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

impl QuadraticFit {
    /// Returns the fit at the first of `points`, in m, which are added in their order. The first
    /// [`NODES_MIN`] must not all lie on a line. `spacing` makes the distances dimensionless.
    pub(crate) fn new(points: &[[f64; 2]], spacing: f64) -> Self {
        let mut count = NODES_MIN.min(points.len());
        loop {
            let ConditionedFit { fit, condition } = Self::fit_all(&points[..count], spacing);
            if condition >= CONDITION_MIN || count == points.len() {
                return fit;
            }
            count += 1;
        }
    }

    /// Returns the fit to all `points`, with distances over `spacing`.
    fn fit_all(points: &[[f64; 2]], spacing: f64) -> ConditionedFit {
        let offsets: Vec<[f64; 2]> = points
            .iter()
            .map(|point| [0, 1].map(|k| (point[k] - points[0][k]) / spacing))
            .collect();
        let roots: Vec<f64> =
            offsets.iter().map(|[u, v]| (1.0 / (1.0 + u * u + v * v)).sqrt()).collect();

        // An orthonormal basis of the linear functions, and the coefficients of 1, u, v in it.
        let linear_functions = [|_: [f64; 2]| 1.0, |[u, _]: [f64; 2]| u, |[_, v]: [f64; 2]| v];
        let mut basis: Vec<Vec<f64>> = Vec::new();
        let mut coefficients = [[0.0; 3]; 3];
        for (k, function) in linear_functions.into_iter().enumerate() {
            let mut column = weighted_column(&offsets, &roots, function);
            project(&mut column, &basis, &mut coefficients[k]);
            let length = dot(&column, &column).sqrt();
            coefficients[k][k] = length;
            basis.push(column.into_iter().map(|x| x / length).collect());
        }

        // The quadratics less their linear parts. The factor of uv makes the three rotate like a
        // tensor.
        let quadratics = [
            |[u, _]: [f64; 2]| 0.5 * u * u,
            |[u, v]: [f64; 2]| std::f64::consts::FRAC_1_SQRT_2 * u * v,
            |[_, v]: [f64; 2]| 0.5 * v * v,
        ];
        let mut linear_parts = [[0.0; 3]; 3];
        let mut residuals = [const { Vec::new() }; 3];
        for (k, function) in quadratics.into_iter().enumerate() {
            let mut column = weighted_column(&offsets, &roots, function);
            project(&mut column, &basis, &mut linear_parts[k]);
            residuals[k] = column;
        }

        // The normal equations give the second derivatives.
        let normal = [0, 1, 2].map(|i| [0, 1, 2].map(|j| dot(&residuals[i], &residuals[j])));
        let ConditionedInverse { inverse, condition } = invert(normal);
        let seconds: [Vec<f64>; 3] = inverse.map(|row| {
            (0..points.len())
                .map(|node| (0..3).map(|k| row[k] * residuals[k][node]).sum::<f64>() * roots[node])
                .collect()
        });

        // The linear part of the remainder, in 1, u, v, by back substitution.
        let linear: Vec<[f64; 3]> = (0..points.len())
            .map(|node| {
                let remainder = [0, 1, 2].map(|i| {
                    let curved: f64 = (0..3).map(|k| linear_parts[k][i] * seconds[k][node]).sum();
                    basis[i][node] * roots[node] - curved
                });
                let v = remainder[2] / coefficients[2][2];
                let u = (remainder[1] - coefficients[2][1] * v) / coefficients[1][1];
                let constant = (remainder[0] - coefficients[1][0] * u - coefficients[2][0] * v)
                    / coefficients[0][0];
                [constant, u, v]
            })
            .collect();

        let first = [1, 2].map(|k| linear.iter().map(|terms| terms[k] / spacing).collect());
        let square = spacing * spacing;
        let [weft, _, warp] = seconds.map(|row| row.iter().map(|x| x / square).collect());
        ConditionedFit { fit: Self { first, second: [weft, warp] }, condition }
    }
}

/// Returns the values of `function` at `offsets`, each times its entry of `roots`.
fn weighted_column(offsets: &[[f64; 2]], roots: &[f64], function: fn([f64; 2]) -> f64) -> Vec<f64> {
    offsets.iter().zip(roots).map(|(&offset, root)| root * function(offset)).collect()
}

/// Subtracts from `column` its components along the orthonormal `basis`, twice because of rounding,
/// and adds the components to `parts`.
fn project(column: &mut [f64], basis: &[Vec<f64>], parts: &mut [f64; 3]) {
    for _ in 0..2 {
        for (vector, part) in basis.iter().zip(parts.iter_mut()) {
            let along = dot(column, vector);
            *part += along;
            column.iter_mut().zip(vector).for_each(|(x, unit)| *x -= along * unit);
        }
    }
}

/// Inverts the symmetric `matrix` on the eigenvectors whose eigenvalues are not too small. On the
/// others the result is zero.
fn invert(mut matrix: [[f64; 3]; 3]) -> ConditionedInverse {
    // Jacobi rotations make the matrix diagonal.
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
    // Sum over the determined eigenvectors.
    let mut inverse = [[0.0; 3]; 3];
    for (k, vector) in vectors.iter().enumerate() {
        if matrix[k][k] > DETERMINED_MIN * largest {
            for i in 0..3 {
                for j in 0..3 {
                    inverse[i][j] += vector[i] * vector[j] / matrix[k][k];
                }
            }
        }
    }
    let condition = if largest > 0.0 { smallest / largest } else { 0.0 };
    ConditionedInverse { inverse, condition }
}
