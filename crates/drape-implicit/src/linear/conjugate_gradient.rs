//! Preconditioned conjugate gradients, truncated at negative curvature.

use pulp::{Arch, Simd, WithSimd};

use crate::linear::block;
use crate::linear::lanes::{Columns, LANES};
use crate::linear::level_schedule::chunk::{self, Chunk, LIGHT, PerChunk, PerRow};
use crate::linear::level_schedule::layout::BatchLayout;
use crate::linear::level_schedule::partial_sum::{PartialProduct, add_from_other_chunks};
use crate::linear::packed_matrix::PackedMatrix;
use crate::linear::preconditioner::{Preconditioner, ScaledResidual};
use crate::linear::vector::{add_scaled, dot, sum};

/// Reason why conjugate gradients ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Ending {
    /// The target was met.
    Converged,
    /// The iteration limit was reached, or a direction of negative curvature after some progress.
    /// The solution so far is a descent direction.
    Truncated,
    /// A direction of negative curvature was met before the residual was smaller than the right
    /// side.
    Indefinite,
}

/// Number of iterations of a solve, and the reason why it ended.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Outcome {
    pub iterations: usize,
    pub ending: Ending,
}

/// Accuracy at which a solve ends. The solve ends as soon as one of the two values is reached.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Target {
    /// Norm of the residual.
    pub residual: f64,
    /// Decrease of the energy in the last two iterations, as a fraction of the decrease in all
    /// iterations.
    pub energy: f64,
}

/// Matrix and its preconditioner.
pub(crate) struct Preconditioned<'a> {
    pub arch: Arch,
    pub layout: &'a BatchLayout,
    pub matrix: &'a PackedMatrix,
    pub preconditioner: &'a mut Preconditioner,
}

/// Work space of the iteration: vectors by rows of the layout. Rows without a particle hold zeros.
#[derive(Debug)]
pub(crate) struct ConjugateGradient {
    solution: Columns<f64>,
    residual: Columns<f64>,
    direction: Columns<f64>,
    products: Vec<PartialProduct>,
    /// Partial sum of each chunk.
    sums: Vec<f64>,
}

impl ConjugateGradient {
    /// Allocates work space for `layout`.
    pub(crate) fn new(layout: &BatchLayout) -> Self {
        let zeros = Columns::new(layout.rows);
        Self {
            solution: zeros.clone(),
            residual: zeros.clone(),
            direction: zeros,
            products: layout.chunks.iter().map(PartialProduct::new).collect(),
            sums: vec![0.0; layout.chunks.len()],
        }
    }

    /// Solves `A x = b` from `x = 0` until `target` is met, in at least one iteration and at most
    /// `limit` iterations. `x` holds `b ≠ 0` on entry.
    ///
    /// The decrease of the energy `½ xᵀA x − bᵀx` in an iteration is half the square of the step in
    /// the norm of `A`. The energy above the minimum is half the square of the error \[HS52\]. As
    /// long as the decreases become smaller fast, the last two estimate the energy above the
    /// minimum.
    ///
    /// At negative curvature the solution so far is kept if its residual is smaller than `b`
    /// \[DS83\]. A restart with a definite matrix instead took a third more iterations on a cloth
    /// that comes to rest on a cube (35 300 instead of 25 900). Keeping every such solution took 19
    /// 300 iterations there, but three times as many evaluations of the forces on a T-shirt, where
    /// the line search shortened most such steps.
    pub(crate) fn solve(
        &mut self,
        system: Preconditioned<'_>,
        x: &mut [f64],
        target: Target,
        limit: usize,
    ) -> Outcome {
        // Particles are stored in the rows of the layout.
        let row_of = &system.layout.order.row_of;
        for (b, &row) in block::triples(x).iter().zip(row_of) {
            for (column, b) in self.residual.0.iter_mut().zip(b) {
                column[row as usize] = *b;
            }
        }
        for column in &mut self.solution.0 {
            column.fill(0.0);
        }

        let outcome = self.iterate(system, target, limit);

        for (x, &row) in block::triples_mut(x).iter_mut().zip(row_of) {
            for (x, column) in x.iter_mut().zip(&self.solution.0) {
                *x = column[row as usize];
            }
        }
        outcome
    }

    /// Iterates until `target` is met, in at most `limit` iterations. The residual holds `b` on
    /// entry.
    ///
    /// Access to the vectors takes most of the time besides the matrix. Each vector is therefore
    /// read as rarely as the method allows. The preconditioned residual is not copied out of the
    /// preconditioner.
    fn iterate(&mut self, system: Preconditioned<'_>, target: Target, limit: usize) -> Outcome {
        let Preconditioned { arch, layout, matrix, preconditioner } = system;

        // The scale keeps the preconditioner's numbers in the range of single precision.
        let [x, y, z] = &self.residual.0;
        let start = (dot(x, x) + dot(y, y) + dot(z, z)).sqrt();
        let mut scale = start;
        self.write_image(preconditioner.image_mut(), 1.0 / scale);
        let residual = ScaledResidual { numbers: &self.residual, factor: 1.0 / scale };
        preconditioner.apply(arch, layout, residual);
        let mut weight = self.weight(arch, layout, preconditioner.image(), scale);
        self.update_direction(
            arch,
            layout,
            preconditioner.image(),
            DirectionUpdate { factor: 0.0, scale },
        );

        let mut total_decrease = 0.0;
        let mut last_decrease = f64::INFINITY;
        for iteration in 1..=limit {
            let curvature = matrix.multiply(arch, layout, &self.direction, &mut self.products);
            // Written so that a NaN ends the iteration too.
            let positive = curvature > 0.0 && weight > 0.0;
            if !positive {
                let worthwhile = scale < start;
                let ending = if worthwhile { Ending::Truncated } else { Ending::Indefinite };
                return Outcome { iterations: iteration, ending };
            }

            let step = weight / curvature;
            let stride = Stride { step, image_factor: 1.0 / scale };
            let length = self.advance(arch, layout, preconditioner.image_mut(), stride).sqrt();
            let decrease = step * weight;
            total_decrease += decrease;
            let recent_decrease = last_decrease + decrease;
            last_decrease = decrease;
            if length <= target.residual || recent_decrease <= target.energy * total_decrease {
                return Outcome { iterations: iteration, ending: Ending::Converged };
            }

            let residual = ScaledResidual { numbers: &self.residual, factor: 1.0 / scale };
            preconditioner.apply(arch, layout, residual);
            let image = preconditioner.image();
            let next = self.weight(arch, layout, image, scale);
            self.update_direction(
                arch,
                layout,
                image,
                DirectionUpdate { factor: next / weight, scale },
            );
            weight = next;
            scale = length;
        }
        Outcome { iterations: limit, ending: Ending::Truncated }
    }

    /// Writes the residual times `factor` into `image`.
    fn write_image(&self, image: &mut Columns<f32>, factor: f64) {
        for (image, residual) in image.0.iter_mut().zip(&self.residual.0) {
            for (image, r) in image.iter_mut().zip(residual) {
                *image = (r * factor) as f32;
            }
        }
    }

    /// Takes the step `stride` along the direction, and writes the scaled residual into `image`.
    /// Returns the square norm of the residual.
    fn advance(
        &mut self,
        arch: Arch,
        layout: &BatchLayout,
        image: &mut Columns<f32>,
        stride: Stride,
    ) -> f64 {
        let Self { solution, residual, direction, products, sums } = self;
        let (direction, products) = (&*direction, &products[..]);
        let vectors =
            (PerRow::new(&mut solution.0), PerRow::new(&mut residual.0), PerRow::new(&mut image.0));
        let output = (PerChunk(&mut *sums), vectors);
        chunk::for_each(&layout.chunks, LIGHT, output, &|chunk, (PerChunk(sums), vectors)| {
            let advance = Advance { layout, chunk, direction, products, vectors, stride };
            sums[0] = arch.dispatch(advance);
        });
        sums.iter().sum()
    }

    /// Returns the dot product `Σ rᵢ zᵢ` of the residual `r` and `z`, the `image` times `scale`.
    fn weight(
        &mut self,
        arch: Arch,
        layout: &BatchLayout,
        image: &Columns<f32>,
        scale: f64,
    ) -> f64 {
        let Self { residual, sums, .. } = self;
        let residual = &*residual;
        chunk::for_each(&layout.chunks, LIGHT, PerChunk(&mut *sums), &|chunk, PerChunk(sums)| {
            sums[0] = arch.dispatch(DotWithImage { chunk, residual, image, scale });
        });
        sums.iter().sum()
    }

    /// Replaces the direction `d` by `z + factor · d`, with `z` the `image` times the scale of
    /// `update`.
    fn update_direction(
        &mut self,
        arch: Arch,
        layout: &BatchLayout,
        image: &Columns<f32>,
        update: DirectionUpdate,
    ) {
        let direction = PerRow::new(&mut self.direction.0);
        chunk::for_each(&layout.chunks, LIGHT, direction, &|chunk, PerRow(direction)| {
            arch.dispatch(UpdateDirection { chunk, image, direction, update });
        });
    }
}

/// Step along a direction.
#[derive(Clone, Copy)]
struct Stride {
    /// Length of the step, in multiples of the direction.
    step: f64,
    /// Factor of the residual's copy in single precision after the step.
    image_factor: f64,
}

/// Coefficients of a new direction, the sum of the image and the old direction.
#[derive(Clone, Copy)]
struct DirectionUpdate {
    /// Factor of the old direction.
    factor: f64,
    /// Factor of the image.
    scale: f64,
}

/// Adds `step · d` to a chunk of the solution, subtracts `step · A d` from the residual's chunk and
/// writes the image of the residual. Returns the chunk's contribution to the new `‖r‖₂²`.
struct Advance<'a> {
    layout: &'a BatchLayout,
    chunk: &'a Chunk,
    direction: &'a Columns<f64>,
    products: &'a [PartialProduct],
    vectors: (PerRow<'a, f64, 3>, PerRow<'a, f64, 3>, PerRow<'a, f32, 3>),
    stride: Stride,
}

impl WithSimd for Advance<'_> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> f64 {
        let Self { layout, chunk, direction, products, vectors, stride } = self;
        let (PerRow(solution), PerRow(mut residual), PerRow(image)) = vectors;
        let Stride { step, image_factor } = stride;
        let first = chunk.rows.start;

        // Products of other chunks with rows of this chunk come first, in the order of the chunks.
        add_from_other_chunks(&mut residual, -step, (&layout.chunks, chunk), |source| {
            &products[source.index].rows
        });
        for &entry in &chunk.incoming {
            let entry = entry as usize;
            let row = layout.irregular[entry].column as usize - first;
            let source = &layout.chunks[layout.chunk_of_entry(entry)];
            let push = products[source.index].pushes[entry - source.irregular.start];
            for (residual, push) in residual.iter_mut().zip(push) {
                residual[row] -= step * push;
            }
        }

        let mut square = 0.0;
        let chunk_products = &products[chunk.index].rows.0;
        for ((residual, product), image) in residual.into_iter().zip(chunk_products).zip(image) {
            let product = &product[first - chunk.window.start..];
            square += update_residual(step, residual, product, Image { image, image_factor });
        }
        for (solution, direction) in solution.into_iter().zip(&direction.0) {
            add_scaled(solution, step, &direction[chunk.rows.clone()]);
        }
        square
    }
}

/// Computes the dot product of a chunk of the residual with its image times `scale`.
struct DotWithImage<'a> {
    chunk: &'a Chunk,
    residual: &'a Columns<f64>,
    image: &'a Columns<f32>,
    scale: f64,
}

impl WithSimd for DotWithImage<'_> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> f64 {
        let Self { chunk, residual, image, scale } = self;
        let mut sum = 0.0;
        for (residual, image) in residual.0.iter().zip(&image.0) {
            let rows = chunk.rows.clone();
            sum += dot_scaled(&residual[rows.clone()], &image[rows], scale);
        }
        sum
    }
}

/// Updates a chunk of the direction.
struct UpdateDirection<'a> {
    chunk: &'a Chunk,
    image: &'a Columns<f32>,
    direction: [&'a mut [f64]; 3],
    update: DirectionUpdate,
}

impl WithSimd for UpdateDirection<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { chunk, image, direction, update: DirectionUpdate { factor, scale } } = self;
        for (direction, image) in direction.into_iter().zip(&image.0) {
            update_direction(direction, factor, &image[chunk.rows.clone()], scale);
        }
    }
}

/// Copy of a residual in single precision, times `image_factor`.
struct Image<'a> {
    image: &'a mut [f32],
    image_factor: f64,
}

/// Subtracts `step · p` from `r` and writes the `image` of `r`. Returns the new `‖r‖₂²`.
#[inline(always)]
fn update_residual(step: f64, r: &mut [f64], p: &[f64], image: Image<'_>) -> f64 {
    let Image { image, image_factor } = image;
    let mut partial = [0.0; LANES];
    let (heads, _) = r.as_chunks_mut::<LANES>();
    let (products, _) = p.as_chunks::<LANES>();
    let (images, _) = image.as_chunks_mut::<LANES>();
    for ((r, p), image) in heads.iter_mut().zip(products).zip(images) {
        for k in 0..LANES {
            r[k] -= step * p[k];
            partial[k] += r[k] * r[k];
            image[k] = (r[k] * image_factor) as f32;
        }
    }
    sum(partial)
}

/// Returns the dot product `Σ rᵢ zᵢ`, with `z` the `image` times `factor`.
#[inline(always)]
fn dot_scaled(r: &[f64], image: &[f32], factor: f64) -> f64 {
    let mut partial = [0.0; LANES];
    for (r, image) in r.as_chunks::<LANES>().0.iter().zip(image.as_chunks::<LANES>().0) {
        for k in 0..LANES {
            partial[k] += r[k] * (f64::from(image[k]) * factor);
        }
    }
    sum(partial)
}

/// Replaces `d` by `z + factor · d`, with `z` the `image` times `scale`.
#[inline(always)]
fn update_direction(d: &mut [f64], factor: f64, image: &[f32], scale: f64) {
    for (d, image) in d.iter_mut().zip(image) {
        *d = f64::from(*image) * scale + factor * *d;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linear::block_matrix::BlockMatrix;
    use crate::linear::level_schedule::LevelSchedule;
    use crate::linear::level_schedule::partition::Partition;
    use crate::linear::sparsity::Sparsity;
    use crate::linear::vector::norm;

    /// The Laplacian of an n × n grid, shifted: its incomplete factor is not exact.
    fn grid(n: usize, shift: f64) -> BlockMatrix {
        let cells = (0..n).flat_map(|i| (0..n).map(move |j| (i, j)));
        let pairs: Vec<[usize; 2]> = cells
            .flat_map(|(i, j)| [(i, j, i, j + 1), (i, j, i + 1, j)])
            .filter(|&(.., i, j)| i < n && j < n)
            .map(|(a, b, c, d)| [a * n + b, c * n + d])
            .collect();
        let mut matrix = BlockMatrix::zeros(Sparsity::from_pairs(n * n, pairs.clone()).unwrap());
        let scaled = |s: f64| [s, 0.0, 0.0, 0.0, s, 0.0, 0.0, 0.0, s];
        for i in 0..n * n {
            matrix.add(i, i, &scaled(4.0 + shift));
        }
        for [i, j] in pairs {
            matrix.add(i, j, &scaled(-1.0));
        }
        matrix
    }

    /// Solves for a right side in at most so many iterations.
    fn solve_for(
        matrix: &BlockMatrix,
        b: &[f64],
        target: Target,
        limit: usize,
    ) -> (Vec<f64>, Outcome) {
        let schedule =
            LevelSchedule::new(matrix.sparsity(), &Partition::into_parts(matrix.sparsity(), 1));
        let layout = &schedule.layout;
        let mut packed = PackedMatrix::new(layout);
        let arch = Arch::new();
        packed.pack(arch, layout, matrix);
        let mut preconditioner = Preconditioner::new(layout, None);
        preconditioner.factorise(arch, &schedule, matrix, &packed).unwrap();
        let mut x = b.to_vec();
        let system =
            Preconditioned { arch, layout, matrix: &packed, preconditioner: &mut preconditioner };
        let outcome = ConjugateGradient::new(layout).solve(system, &mut x, target, limit);
        (x, outcome)
    }

    /// With a right side that is a sine of this many radians from one number to the next.
    fn solve(matrix: &BlockMatrix, phase: f64, limit: usize) -> (f64, usize, Ending) {
        let size = 3 * matrix.sparsity().particle_count();
        let b: Vec<f64> = (0..size).map(|k| (1.0 + k as f64 * phase).sin()).collect();
        let target = Target { residual: 1e-10 * norm(&b), energy: 0.0 };
        let (x, Outcome { iterations, ending }) = solve_for(matrix, &b, target, limit);
        let mut back = vec![0.0; size];
        matrix.write_product(&x, &mut back);
        add_scaled(&mut back, -1.0, &b);
        assert!(ending == Ending::Indefinite || dot(&x, &b) > 0.0, "not a descent direction");
        (norm(&back) / norm(&b), iterations, ending)
    }

    #[test]
    fn a_definite_system_is_solved_to_the_target() {
        let (residual, iterations, ending) = solve(&grid(20, 1e-3), 0.37, 200);
        assert_eq!(ending, Ending::Converged);
        // The recurrence's residual drifts from the true one by rounding only.
        assert!(residual < 1.1e-10, "{residual:e}");
        assert!(iterations < 40, "{iterations} iterations");
    }

    #[test]
    fn negative_curvature_and_a_short_limit_are_told_apart() {
        let (_, iterations, indefinite) = solve(&grid(20, -1.0), 0.0, 200);
        assert_eq!(
            (iterations, indefinite),
            (1, Ending::Indefinite),
            "smooth, where it is not positive"
        );
        let (residual, iterations, late) = solve(&grid(20, -1.0), 0.37, 200);
        assert_eq!(late, Ending::Truncated);
        assert!(iterations > 1 && residual < 1.0, "{residual:e} after {iterations}");
        let (residual, iterations, truncated) = solve(&grid(20, 1e-3), 0.37, 5);
        assert_eq!((iterations, truncated), (5, Ending::Truncated));
        assert!(residual > 1e-10, "{residual:e}");
    }

    #[test]
    fn energies_gained_tell_the_error_that_is_left() {
        let matrix = grid(40, 1e-3);
        let b = vec![1.0; 3 * 40 * 40];
        let solution = |target| {
            let (x, outcome) = solve_for(&matrix, &b, target, 500);
            assert_eq!(outcome.ending, Ending::Converged);
            x
        };
        let exact = solution(Target { residual: 1e-12, energy: 0.0 });
        let energy = |x: &[f64]| {
            let mut image = vec![0.0; x.len()];
            matrix.write_product(x, &mut image);
            dot(x, &image)
        };
        for fraction in [0.1, 0.01, 1e-4] {
            let mut error = solution(Target { residual: 0.0, energy: fraction });
            add_scaled(&mut error, -1.0, &exact);
            let left = energy(&error) / energy(&exact);
            assert!(left < fraction && left > 1e-3 * fraction, "{left:e} of {fraction:e}");
        }
    }
}
