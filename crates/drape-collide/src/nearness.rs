use crate::crossing::{Intersection, intersections};
use crate::error::Error;
use crate::pair::Pair;
use crate::surface_contact::{SurfaceContact, Touching};

/// How the surfaces lie to each other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfaceSummary {
    /// CandidatePairs within their activation_distance.
    pub touching: usize,
    /// Smallest distance of a pair; infinite if none is near, in m.
    pub min_distance: f64,
    /// Smallest distance over the min_separation that its pair keeps.
    pub min_ratio: f64,
}

/// A pair and its distance at the positions of the last evaluation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PairDistance<'a> {
    /// The pair.
    pub pair: &'a Pair,
    /// Distance of its primitives, in m.
    pub distance: f64,
}

impl<'a> PairDistance<'a> {
    fn of(touching: &'a Touching) -> PairDistance<'a> {
        PairDistance { pair: &touching.pair, distance: touching.gap.distance() }
    }
}

impl SurfaceContact {
    /// Every crossing of the surface with itself and the bodies that it is kept from at the free vertices' positions in
    /// the open step; exact.
    ///
    /// # Errors
    /// Positions that are none.
    pub fn intersections(&self, positions: &[f64]) -> Result<Vec<Intersection>, Error> {
        let mut found = self.intersections_with_released(positions)?;
        let kept =
            |crossing: &Intersection| self.surface.share(&self.vertices_of(*crossing)).is_some();
        found.retain(|crossing| self.filter.guards.exact && kept(crossing));
        Ok(found)
    }

    /// The same with those of cloth that has let a body through.
    ///
    /// # Errors
    /// Positions that are none.
    pub fn intersections_with_released(
        &self,
        positions: &[f64],
    ) -> Result<Vec<Intersection>, Error> {
        intersections(&self.surface, &self.all(positions, self.progress))
    }

    /// The vertices of an edge and a triangle that cross.
    pub(crate) fn vertices_of(&self, crossing: Intersection) -> [u32; 5] {
        let [a, b] = self.surface.edges()[crossing.edge as usize];
        let [c, d, e] = self.surface.triangles()[crossing.triangle as usize];
        [a, b, c, d, e]
    }

    /// How near the surfaces are to each other at the free vertices' positions.
    ///
    /// # Errors
    /// Positions that are none, or too many pairs.
    pub fn summary_at(&mut self, positions: &[f64]) -> Result<SurfaceSummary, Error> {
        self.look(positions);
        self.failure.clone().map_or_else(|| Ok(self.summary()), Err)
    }

    /// How near the surfaces are to each other at the places looked at last.
    pub fn summary(&self) -> SurfaceSummary {
        let mut nearness = SurfaceSummary {
            touching: self.touching().count(),
            min_distance: f64::INFINITY,
            min_ratio: f64::INFINITY,
        };
        for Touching { pair, gap } in self.touching() {
            nearness.min_distance = nearness.min_distance.min(gap.distance());
            nearness.min_ratio = nearness.min_ratio.min(gap.distance() / pair.min_separation);
        }
        nearness
    }

    /// The pair that is nearest to what it keeps at the places looked at last, with its distance, in m.
    pub fn closest_pair(&self) -> Option<PairDistance<'_>> {
        let ratio = |touching: &&Touching| touching.gap.distance() / touching.pair.min_separation;
        let least = self.touching().min_by(|a, b| ratio(a).total_cmp(&ratio(b)));
        least.map(PairDistance::of)
    }

    /// The pairs that are nearer than they keep at the places looked at last, each with its distance, in m.
    pub fn pairs_below_min_separation(&self) -> impl Iterator<Item = PairDistance<'_>> {
        let near = self.touching().map(PairDistance::of);
        near.filter(|PairDistance { pair, distance }| !(*distance >= pair.min_separation))
    }
}
