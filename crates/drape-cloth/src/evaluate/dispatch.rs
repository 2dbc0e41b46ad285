//! Dispatch of the kernels to the vector instructions of the machine.
//!
//! Each struct is a call of one kernel. `Arch::dispatch` inlines the kernel and all functions below
//! it into a function that is compiled for each set of instructions.

use pulp::{Simd, WithSimd};

use crate::kernel::buffers::{StripBuffers, StripTrial};
use crate::kernel::energy::StripCommit;
use crate::kernel::{energy, forces, stiffness};
use crate::rim;
use crate::rim::connectors::RimShape;
use crate::rim::memories::{RimMemories, RimMemoriesMut};
use crate::rim::stiffness::RimStiffness;

pub(crate) struct AddForces<'a> {
    pub(crate) buffers: &'a mut StripBuffers,
    pub(crate) trial: StripTrial<'a>,
    pub(crate) forces: &'a mut [f64],
}

impl WithSimd for AddForces<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        forces::add_forces(self.buffers, &self.trial, self.forces);
    }
}

pub(crate) struct Potential<'a> {
    pub(crate) buffers: &'a mut StripBuffers,
    pub(crate) trial: StripTrial<'a>,
}

impl WithSimd for Potential<'_> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> f64 {
        energy::potential(self.buffers, &self.trial)
    }
}

pub(crate) struct AddStiffness<'a> {
    pub(crate) buffers: &'a mut StripBuffers,
    pub(crate) trial: StripTrial<'a>,
    pub(crate) definite: bool,
    pub(crate) values: &'a mut [f64],
}

impl WithSimd for AddStiffness<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        stiffness::add_stiffness(self.buffers, &self.trial, self.definite, self.values);
    }
}

pub(crate) struct Commit<'a> {
    pub(crate) buffers: &'a mut StripBuffers,
    pub(crate) commit: StripCommit<'a>,
}

impl WithSimd for Commit<'_> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> f64 {
        energy::commit(self.buffers, self.commit)
    }
}

pub(crate) struct AddRimForces<'a> {
    pub(crate) shape: RimShape<'a>,
    pub(crate) memories: &'a RimMemories,
    pub(crate) forces: &'a mut [f64],
}

impl WithSimd for AddRimForces<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        rim::forces::add_forces(&self.shape, self.memories, self.forces);
    }
}

pub(crate) struct RimPotential<'a> {
    pub(crate) shape: RimShape<'a>,
    pub(crate) memories: &'a RimMemories,
}

impl WithSimd for RimPotential<'_> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> f64 {
        rim::energy::potential(&self.shape, self.memories)
    }
}

pub(crate) struct AddRimStiffness<'a> {
    pub(crate) stiffness: RimStiffness<'a>,
    pub(crate) values: &'a mut [f64],
}

impl WithSimd for AddRimStiffness<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        rim::stiffness::add_stiffness(&self.stiffness, self.values);
    }
}

pub(crate) struct CommitRim<'a> {
    pub(crate) shape: RimShape<'a>,
    pub(crate) memories: RimMemoriesMut<'a>,
}

impl WithSimd for CommitRim<'_> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> f64 {
        rim::energy::commit(&self.shape, self.memories)
    }
}
