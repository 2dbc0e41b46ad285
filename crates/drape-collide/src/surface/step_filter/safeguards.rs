//! Safeguards of the step filter. Tests switch each one off to see that it is needed.

/// Safeguards of the step filter, which are all on except in tests of this crate.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Safeguards {
    /// Vertices of a pair with too little room do not approach.
    pub(crate) freeze: bool,
    /// No vertex drifts farther than the detected pairs allow.
    pub(crate) drift_budget: bool,
    /// The known distance of a pair is reduced by the drift of its vertices since detection.
    pub(crate) drift_bound: bool,
    /// Pairs are detected along trajectories that the listed pairs do not cover.
    pub(crate) swept_detection: bool,
}

impl Default for Safeguards {
    fn default() -> Safeguards {
        Safeguards { freeze: true, drift_budget: true, drift_bound: true, swept_detection: true }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        CcdFilter, ContactDistances, Detector, FractionLimit, StepFraction, Surface, SurfaceParts,
        intersections,
    };

    const DISTANCES: ContactDistances =
        ContactDistances { activation_distance: 1e-3, min_separation: 1e-4 };
    const MARGIN: f64 = 4e-3;

    /// Two parallel triangles of 0.1 m so far apart, the upper one to the side by a third.
    fn triangles(apart: f64) -> (Surface, Vec<f64>) {
        let flat = [[0.0, 0.0], [0.1, 0.0], [0.0, 0.1], [0.03, 0.03], [0.13, 0.03], [0.03, 0.13]];
        let height = |k: usize| if k < 3 { 0.0 } else { apart };
        let positions: Vec<f64> =
            flat.iter().enumerate().flat_map(|(k, [x, y])| [*x, *y, height(k)]).collect();
        let surface = Surface::new(SurfaceParts {
            rest_positions: positions.clone(),
            triangles: vec![[0, 1, 2], [3, 4, 5]],
            areas: vec![1e-3; 6],
            groups: vec![0, 0, 0, 1, 1, 1],
            distances: vec![DISTANCES; 2],
            free_vertices: 6,
            seam_pairs: Vec::new(),
            ties: Vec::new(),
        });
        (surface.unwrap(), positions)
    }

    /// What one corner of the upper triangle does that is told to go down by so much, in so many
    /// steps without a new detection: the least height of it, and whether the triangles meet.
    ///
    /// The pairs are those of the margin, but the filter is told another.
    fn drop_corner(
        safeguards: Safeguards,
        (apart, drop, steps): (f64, f64, usize),
        (margin, told): (f64, f64),
    ) -> [(f64, bool); 2] {
        [false, true].map(|scalar| {
            let (surface, mut positions) = triangles(apart);
            let mut detector = Detector::default();
            let mut pairs = detector.detect(&surface, &positions, margin).unwrap().clone();
            pairs.margin = told;
            let mut filter = CcdFilter::default();
            filter.safeguards = safeguards;
            let mut met = false;
            for _ in 0..steps {
                let mut displacement = vec![0.0; positions.len()];
                displacement[11] = -drop;
                if scalar {
                    let fraction =
                        filter.common_fraction(&pairs, &positions, &displacement).unwrap().value;
                    displacement[11] *= fraction;
                } else {
                    filter.truncate(&pairs, &positions, &mut displacement).unwrap();
                }
                positions[11] += displacement[11];
                met |= !intersections(&surface, &positions).unwrap().is_empty();
            }
            (positions[11], met)
        })
    }

    #[test]
    fn a_pair_without_room_is_frozen_or_it_crosses() {
        let min_separation = 2.0 * DISTANCES.min_separation;
        // Half a nanometre of room, and a displacement that ends just behind the other triangle.
        let drop = (min_separation + 5e-10, 1.1 * min_separation, 1);
        for (height, met) in drop_corner(Safeguards::default(), drop, (MARGIN, MARGIN)) {
            assert!(height >= min_separation && !met, "at {height}, met {met}");
        }
        let unguarded = Safeguards { freeze: false, ..Safeguards::default() };
        let [(height, met), _] = drop_corner(unguarded, drop, (MARGIN, MARGIN));
        assert!(height < 0.0 && met, "at {height}, met {met}");
    }

    #[test]
    fn a_pair_that_was_far_is_kept_apart_by_the_budget_or_it_crosses() {
        // Just out of the list, and ten steps of half a margin.
        let drop = (2.0 * DISTANCES.activation_distance + 1.001 * MARGIN, 0.5 * MARGIN, 10);
        for (height, met) in drop_corner(Safeguards::default(), drop, (MARGIN, MARGIN)) {
            assert!(
                height >= 2.0 * DISTANCES.activation_distance && !met,
                "at {height}, met {met}"
            );
        }
        let unguarded = Safeguards { drift_budget: false, ..Safeguards::default() };
        for (height, met) in drop_corner(unguarded, drop, (MARGIN, MARGIN)) {
            assert!(height < 0.0 && met, "at {height}, met {met}");
        }
    }

    #[test]
    fn a_pair_is_as_near_as_its_vertices_have_drifted_or_it_crosses() {
        // Each step alone is a good way shorter than the distance at the detection.
        let apart = 0.4 * MARGIN;
        let drop = (apart, 0.6 * apart, 2);
        for (height, met) in drop_corner(Safeguards::default(), drop, (MARGIN, MARGIN)) {
            assert!(height >= 2.0 * DISTANCES.min_separation && !met, "at {height}, met {met}");
        }
        let unguarded = Safeguards { drift_bound: false, ..Safeguards::default() };
        for (height, met) in drop_corner(unguarded, drop, (MARGIN, MARGIN)) {
            assert!(height < 0.0 && met, "at {height}, met {met}");
        }
    }

    #[test]
    fn pairs_are_detected_with_the_whole_margin_or_they_cross() {
        // Within the margin, but not within a hundredth of it.
        let drop = (2.0 * DISTANCES.activation_distance + 0.1 * MARGIN, MARGIN, 2);
        for (height, met) in drop_corner(Safeguards::default(), drop, (MARGIN, 3.0 * MARGIN)) {
            assert!(height >= 2.0 * DISTANCES.min_separation && !met, "at {height}, met {met}");
        }
        for (height, met) in drop_corner(Safeguards::default(), drop, (0.01 * MARGIN, 3.0 * MARGIN))
        {
            assert!(height < 0.0 && met, "at {height}, met {met}");
        }
    }

    #[test]
    fn a_pair_that_approaches_keeps_a_tenth_of_its_clearance() {
        let (apart, down) = (1e-3, 0.9e-3);
        let (surface, positions) = triangles(apart);
        let mut detector = Detector::default();
        let pairs = detector.detect(&surface, &positions, MARGIN).unwrap();
        let limit = |down: f64| {
            let upper = (0..18).map(|k| if k > 8 && k % 3 == 2 { -down } else { 0.0 });
            let displacements: Vec<f64> = upper.collect();
            CcdFilter::default().common_fraction(pairs, &positions, &displacements).unwrap()
        };
        let found = limit(down);
        let room = 0.9 * (apart - 2.0 * DISTANCES.min_separation);
        assert!((found.value * down - room).abs() < 1e-9, "{found:?}");
        assert_eq!(found.limit, FractionLimit::Contact);
        assert_eq!(limit(0.5 * room), StepFraction { value: 1.0, limit: FractionLimit::None });
    }

    #[test]
    fn a_pair_without_room_may_part_and_neither_approach_nor_slide() {
        let (surface, positions) = triangles(DISTANCES.min_separation);
        let mut detector = Detector::default();
        let pairs = detector.detect(&surface, &positions, MARGIN).unwrap();
        let fraction = |[x, y, z]: [f64; 3]| {
            let upper = (0..18).map(|k| if k < 9 { 0.0 } else { [x, y, z][k % 3] });
            let displacements: Vec<f64> = upper.collect();
            let mut filter = CcdFilter::default();
            filter.common_fraction(pairs, &positions, &displacements).unwrap().value
        };
        assert_eq!(fraction([0.0, 0.0, 1e-3]), 1.0);
        assert_eq!(fraction([0.0; 3]), 1.0);
        assert_eq!(fraction([0.0, 0.0, -1e-6]), 0.0);
        assert_eq!(fraction([1e-3, 0.0, 0.0]), 0.0);
        // Less than the rounding of the step is no way apart.
        assert_eq!(fraction([0.0, 0.0, 1e-20]), 0.0);
    }
}
