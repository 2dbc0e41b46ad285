//! Points and their distances.

/// Returns the position of `particle` in the flat `positions`, in m.
pub(crate) fn point_of(positions: &[f64], particle: u32) -> [f64; 3] {
    std::array::from_fn(|axis| positions[3 * particle as usize + axis])
}

/// Returns the Euclidean distance of the points `a` and `b`.
pub(crate) fn distance<const N: usize>(a: [f64; N], b: [f64; N]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_distance_is_that_of_pythagoras() {
        assert_eq!(distance([1.0, 2.0, 3.0], [4.0, 6.0, 3.0]), 5.0);
        assert_eq!(distance([5.0], [-5.0]), 10.0);
    }
}
