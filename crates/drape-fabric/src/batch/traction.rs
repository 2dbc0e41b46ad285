//! The law of traction for a batch.
//!
//! `exponential` is the law with an exponential toe. `weighted` are the two laws from papers, with
//! a priming zone and with a polynomial. `toe` and `compression` serve all three.

pub(crate) mod compression;
pub(crate) mod exponential;
pub(crate) mod toe;
pub(crate) mod weighted;

use crate::batch::batch_law::{BatchLaw, Responses};
use crate::batch::lanes::Lanes;
use crate::batch::memories::{Memories, MemoriesMut, MemoryBatch};
use crate::batch::traction::exponential::ExponentialBatch;
use crate::batch::traction::weighted::{WeightedBackbone, WeightedTraction};
use crate::laws::traction::{TractionBackbone, TractionLaw};

/// A [`TractionLaw`] for many connectors side by side.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TractionBatch(PreparedTraction);

/// Prepared law, by its friction.
#[derive(Debug, Clone, Copy, PartialEq)]
enum PreparedTraction {
    Exponential(ExponentialBatch),
    Weighted(WeightedTraction),
}

impl TractionBatch {
    /// Prepares `law` for a batch.
    #[must_use]
    pub fn new(law: TractionLaw) -> Self {
        let TractionLaw { backbone, buckling, .. } = law;
        let rest = backbone.rest_stiffness();
        let weighted = match backbone {
            TractionBackbone::Exponential(toe) => {
                let batch = ExponentialBatch::new(toe, law.proportional(), buckling);
                return Self(PreparedTraction::Exponential(batch));
            }
            TractionBackbone::Primed(primed) => WeightedBackbone::Primed(primed),
            TractionBackbone::Polynomial(polynomial) => WeightedBackbone::Polynomial(polynomial),
        };
        let batch = WeightedTraction::new(weighted, rest, &law.plateau(), buckling);
        Self(PreparedTraction::Weighted(batch))
    }
}

impl BatchLaw for TractionBatch {
    fn append_memories(&self, memories: &mut Memories, count: usize) {
        match &self.0 {
            PreparedTraction::Exponential(law) => law.append_memories(memories, count),
            PreparedTraction::Weighted(law) => law.append_memories(memories, count),
        }
    }

    fn start(&self, memories: &mut Memories, start: usize, deformations: &Lanes) {
        match &self.0 {
            PreparedTraction::Exponential(law) => law.start(memories, start, deformations),
            PreparedTraction::Weighted(law) => law.start(memories, start, deformations),
        }
    }

    #[inline(always)]
    fn respond<const TANGENT: bool>(
        &self,
        memory: &MemoryBatch<'_>,
        trial: &Lanes,
        responses: &mut Responses,
    ) {
        match &self.0 {
            PreparedTraction::Exponential(law) => law.respond::<TANGENT>(memory, trial, responses),
            PreparedTraction::Weighted(law) => law.respond::<TANGENT>(memory, trial, responses),
        }
    }

    #[inline(always)]
    fn add_friction<const TANGENT: bool>(
        &self,
        memory: &MemoryBatch<'_>,
        trial: &Lanes,
        responses: &mut Responses,
    ) {
        match &self.0 {
            PreparedTraction::Exponential(law) => {
                law.add_friction::<TANGENT>(memory, trial, responses)
            }
            PreparedTraction::Weighted(law) => {
                law.add_friction::<TANGENT>(memory, trial, responses)
            }
        }
    }

    #[inline(always)]
    fn add_friction_work(&self, memory: &MemoryBatch<'_>, trial: &Lanes, works: &mut Lanes) {
        match &self.0 {
            PreparedTraction::Exponential(law) => law.add_friction_work(memory, trial, works),
            PreparedTraction::Weighted(law) => law.add_friction_work(memory, trial, works),
        }
    }

    #[inline(always)]
    fn add_work(&self, memory: &MemoryBatch<'_>, trial: &Lanes, works: &mut Lanes) {
        match &self.0 {
            PreparedTraction::Exponential(law) => law.add_work(memory, trial, works),
            PreparedTraction::Weighted(law) => law.add_work(memory, trial, works),
        }
    }

    #[inline(always)]
    fn commit(&self, memories: &mut MemoriesMut<'_>, start: usize, trial: &Lanes) -> Lanes {
        match &self.0 {
            PreparedTraction::Exponential(law) => law.commit(memories, start, trial),
            PreparedTraction::Weighted(law) => law.commit(memories, start, trial),
        }
    }

    #[inline(always)]
    fn add_stored(&self, memory: &MemoryBatch<'_>, energies: &mut Lanes) {
        match &self.0 {
            PreparedTraction::Exponential(law) => law.add_stored(memory, energies),
            PreparedTraction::Weighted(law) => law.add_stored(memory, energies),
        }
    }

    #[inline(always)]
    fn add_friction_stored(&self, memory: &MemoryBatch<'_>, energies: &mut Lanes) {
        match &self.0 {
            PreparedTraction::Exponential(law) => law.add_friction_stored(memory, energies),
            PreparedTraction::Weighted(law) => law.add_friction_stored(memory, energies),
        }
    }
}
