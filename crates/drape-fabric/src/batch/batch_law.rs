//! The interface of a law for a batch.

use drape_hysteresis::Response;

use crate::batch::lanes::{LANES, Lanes};
use crate::batch::memories::{Memories, MemoriesMut, MemoryBatch};

/// Law prepared for many connectors side by side. Results agree with [`Law`](crate::Law) up to
/// rounding.
///
/// Every method is inlined into the caller, so that the compiler builds it for the vector
/// instructions that the caller has selected.
///
/// ```
/// use drape_fabric::{
///     BatchLaw, BendingBackbone, BendingBatch, BendingLaw, BlimanSorine, LANES, Law, Responses,
/// };
///
/// let law = BendingLaw {
///     backbone: BendingBackbone::Linear { rigidity: 1.2e-5 },
///     rest_curvature: 0.0,
///     friction: BlimanSorine::first_order(6e-4, 4.0)?,
/// };
/// let batch = BendingBatch::new(law);
/// let memories = batch.memories(LANES);
/// let mut responses = Responses::default();
/// batch.respond::<true>(&memories.batch(0), &[100.0; LANES], &mut responses);
/// let one = law.respond(&law.virgin(), 100.0);
/// assert!((responses.load[7] / one.load - 1.0).abs() < 1e-12);
/// # Ok::<(), drape_fabric::FrictionError>(())
/// ```
pub trait BatchLaw {
    /// Returns the memories of `count` connectors that were never deformed.
    #[must_use]
    fn memories(&self, count: usize) -> Memories {
        let mut memories = Memories::default();
        self.append_memories(&mut memories, count);
        memories
    }

    /// Appends the memories of `count` connectors that were never deformed to `memories`.
    fn append_memories(&self, memories: &mut Memories, count: usize);

    /// Writes [`LANES`] memories from the index `start` on, of connectors with the given
    /// `deformations` and without friction loads.
    fn start(&self, memories: &mut Memories, start: usize, deformations: &Lanes);

    /// Adds loads, and tangents if `TANGENT`, at the `trial` deformations to `responses`.
    fn respond<const TANGENT: bool>(
        &self,
        memory: &MemoryBatch<'_>,
        trial: &Lanes,
        responses: &mut Responses,
    );

    /// Adds the loads of the friction, and their tangents if `TANGENT`, to `responses`.
    fn add_friction<const TANGENT: bool>(
        &self,
        memory: &MemoryBatch<'_>,
        trial: &Lanes,
        responses: &mut Responses,
    );

    /// Adds the work of the friction per area from `memory` to `trial` to `works`, in J/m².
    fn add_friction_work(&self, memory: &MemoryBatch<'_>, trial: &Lanes, works: &mut Lanes);

    /// Adds the potential within a step per area to `works`, in J/m²: the elastic energy at
    /// `trial`, and the work of the friction from `memory` to `trial`. The additive constant
    /// depends on `memory`.
    fn add_work(&self, memory: &MemoryBatch<'_>, trial: &Lanes, works: &mut Lanes);

    /// Advances the memories from the index `start` on to `trial`. Returns the energies per area
    /// that the friction has dissipated, in J/m².
    fn commit(&self, memories: &mut MemoriesMut<'_>, start: usize, trial: &Lanes) -> Lanes;

    /// Adds the energies per area that the fabric can return from `memory` to `energies`, in J/m².
    fn add_stored(&self, memory: &MemoryBatch<'_>, energies: &mut Lanes);

    /// Adds the energies per area that the friction can return from `memory` to `energies`, in
    /// J/m².
    fn add_friction_stored(&self, memory: &MemoryBatch<'_>, energies: &mut Lanes);
}

/// Loads and tangents of a batch, in the units of [`Response`].
#[derive(Debug, Clone, Copy)]
pub struct Responses {
    /// Loads per width.
    pub load: Lanes,
    /// Derivatives of the loads with respect to the deformations.
    pub tangent: Lanes,
}

impl Responses {
    /// Returns load and tangent of `lane`.
    #[inline(always)]
    #[must_use]
    pub fn lane(&self, lane: usize) -> Response {
        Response { load: self.load[lane], tangent: self.tangent[lane] }
    }
}

impl Default for Responses {
    fn default() -> Self {
        Self { load: [0.0; LANES], tangent: [0.0; LANES] }
    }
}
