use crate::crossing::{Crossing, crossings};
use crate::error::CollideError;
use crate::pair::Pair;
use crate::surface_contact::{SurfaceContact, Touching};

/// How the surfaces lie to each other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Nearness {
    /// Pairs within their reach.
    pub touching: usize,
    /// Smallest distance of a pair; infinite if none is near, in m.
    pub min_distance: f64,
    /// Smallest distance over the separation that its pair keeps.
    pub min_ratio: f64,
}

impl SurfaceContact {
    /// Every crossing of the surface with itself and the bodies that it is kept from at the free vertices' positions in
    /// the open step; exact.
    ///
    /// # Errors
    /// Positions that are none.
    pub fn crossings(&self, positions: &[f64]) -> Result<Vec<Crossing>, CollideError> {
        let mut found = self.intersections(positions)?;
        let kept = |crossing: &Crossing| self.surface.share(&self.vertices_of(*crossing)).is_some();
        found.retain(|crossing| self.filter.guards.exact && kept(crossing));
        Ok(found)
    }

    /// The same with those of cloth that has let a body through.
    ///
    /// # Errors
    /// Positions that are none.
    pub fn intersections(&self, positions: &[f64]) -> Result<Vec<Crossing>, CollideError> {
        crossings(&self.surface, &self.all(positions, self.progress))
    }

    /// The vertices of an edge and a triangle that cross.
    pub(crate) fn vertices_of(&self, crossing: Crossing) -> [u32; 5] {
        let [a, b] = self.surface.edges()[crossing.edge as usize];
        let [c, d, e] = self.surface.triangles()[crossing.triangle as usize];
        [a, b, c, d, e]
    }

    /// How near the surfaces are to each other at the free vertices' positions.
    ///
    /// # Errors
    /// Positions that are none, or too many pairs.
    pub fn survey(&mut self, positions: &[f64]) -> Result<Nearness, CollideError> {
        self.look(positions);
        self.failure.clone().map_or_else(|| Ok(self.nearness()), Err)
    }

    /// How near the surfaces are to each other at the places looked at last.
    pub fn nearness(&self) -> Nearness {
        let mut nearness = Nearness {
            touching: self.touching().count(),
            min_distance: f64::INFINITY,
            min_ratio: f64::INFINITY,
        };
        for Touching { pair, gap } in self.touching() {
            nearness.min_distance = nearness.min_distance.min(gap.distance());
            nearness.min_ratio = nearness.min_ratio.min(gap.distance() / pair.separation);
        }
        nearness
    }

    /// The pair that is nearest to what it keeps at the places looked at last, with its distance, in m.
    pub fn tightest(&self) -> Option<(&Pair, f64)> {
        let ratio = |touching: &&Touching| touching.gap.distance() / touching.pair.separation;
        let least = self.touching().min_by(|a, b| ratio(a).total_cmp(&ratio(b)));
        least.map(|touching| (&touching.pair, touching.gap.distance()))
    }

    /// The pairs that are nearer than they keep at the places looked at last, each with its distance, in m.
    pub fn too_near(&self) -> impl Iterator<Item = (&Pair, f64)> {
        let near = self.touching().map(|touching| (&touching.pair, touching.gap.distance()));
        near.filter(|(pair, distance)| !(*distance >= pair.separation))
    }
}
