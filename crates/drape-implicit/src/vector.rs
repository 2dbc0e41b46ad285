//! Sums over flat vectors, in an order that depends on their length alone.

/// Number of partial sums: enough for the compiler to use the widest registers of the machine, and the
/// same on every machine, so that the bits are too.
const LANES: usize = 8;

/// `Σ aᵢ bᵢ`.
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    let (heads, tail) = a.as_chunks::<LANES>();
    let (other_heads, other_tail) = b.as_chunks::<LANES>();
    let mut partial = [0.0; LANES];
    for (x, y) in heads.iter().zip(other_heads) {
        for k in 0..LANES {
            partial[k] += x[k] * y[k];
        }
    }
    let mut sum = 0.0;
    for (x, y) in tail.iter().zip(other_tail) {
        sum += x * y;
    }
    for half in [4, 2, 1] {
        for k in 0..half {
            partial[k] += partial[k + half];
        }
    }
    partial[0] + sum
}

/// Euclidean length; NaN if an entry is NaN.
pub(crate) fn norm(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}

/// `y + factor · x`.
pub(crate) fn add_scaled(y: &mut [f64], factor: f64, x: &[f64]) {
    for (y, x) in y.iter_mut().zip(x) {
        *y += factor * x;
    }
}

/// `x + step · direction` and `r − step · product` in one pass, with the new `‖r‖₂`.
pub(crate) fn descend(
    step: f64,
    (x, direction): (&mut [f64], &[f64]),
    (r, product): (&mut [f64], &[f64]),
) -> f64 {
    add_scaled(x, step, direction);
    let mut partial = [0.0; LANES];
    let (heads, tail) = r.as_chunks_mut::<LANES>();
    let (products, product_tail) = product.as_chunks::<LANES>();
    for (r, p) in heads.iter_mut().zip(products) {
        for k in 0..LANES {
            r[k] -= step * p[k];
            partial[k] += r[k] * r[k];
        }
    }
    let mut sum = partial.iter().sum::<f64>();
    for (r, p) in tail.iter_mut().zip(product_tail) {
        *r -= step * p;
        sum += *r * *r;
    }
    sum.sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sum_of_squares_of_the_first_integers_is_the_closed_form() {
        for n in [0_u32, 1, 7, 8, 9, 100] {
            let a: Vec<f64> = (1..=n).map(f64::from).collect();
            let closed = f64::from(n) * f64::from(n + 1) * f64::from(2 * n + 1) / 6.0;
            assert_eq!(dot(&a, &a), closed, "n = {n}");
        }
    }
}
