//! Stencils of a rim, one by one: bending about a node along one yarn.

use drape_fabric::{BendingLaw, Fabric, Memory};

use crate::layout::connectors::BendingConnectors;
use crate::measure::bending::{BendingMeasure, BendingResponse};
use crate::measure::block::{Matrix, sum};
use crate::measure::vector::{WeightedNode, add_at, scale, vector_at, weighted_sum};
use crate::panel::lattice::Lattice;
use crate::reference::connector::commit_memory;
use crate::rim::fits::PanelFits;
use crate::rim::neighbourhood::Neighbourhoods;

/// Bending of a neighbourhood along one yarn.
#[derive(Debug, Clone)]
pub(crate) struct ReferenceStencil {
    law: BendingLaw,
    middle: u32,
    /// Particles with their weights in the second difference.
    nodes: Vec<WeightedNode>,
    length: f64,
    area: f64,
    /// Rest curvature that folds add, in 1/m.
    fold: f64,
    memory: Memory,
}

impl ReferenceStencil {
    /// Returns the stencils of a panel in `fabric`, with its particles counted from 0.
    pub(crate) fn for_panel(
        lattice: &Lattice,
        fabric: &Fabric,
        neighbourhoods: &Neighbourhoods<'_>,
        bending: &[BendingConnectors; 2],
    ) -> Vec<Self> {
        let [across, along] = lattice.spacing;
        let sides = [(fabric.warp.bending, along), (fabric.weft.bending, across)];
        let mut all = Vec::new();
        // A stencil of both directions becomes two connectors, one without an area none.
        for stencil in PanelFits::new(lattice, neighbourhoods, bending).stencils {
            for (direction, (law, length)) in sides.into_iter().enumerate() {
                let nodes = stencil
                    .nodes
                    .iter()
                    .map(|node| WeightedNode { node: node.node, weight: node.weights[direction] });
                all.push(Self {
                    law,
                    middle: stencil.middle,
                    nodes: nodes.collect(),
                    length,
                    area: stencil.areas[direction],
                    fold: stencil.folds[direction],
                    memory: Memory::default(),
                });
            }
        }
        all.retain(|stencil| stencil.area > 0.0);
        all
    }

    /// Returns the stencil with its particles counted from `first` on.
    pub(crate) fn shifted(mut self, first: u32) -> Self {
        self.middle += first;
        self.nodes.iter_mut().for_each(|node| node.node += first);
        self
    }

    /// Returns the second difference at `positions` as a [`BendingMeasure`].
    fn measure(&self, positions: &[f64], normals: &[f64]) -> BendingMeasure {
        BendingMeasure {
            second_difference: weighted_sum(positions, &self.nodes),
            normal: vector_at(normals, self.middle),
            length: self.length,
        }
    }

    /// Returns energy per area and derivatives at `positions`.
    fn respond(&self, positions: &[f64], normals: &[f64], definite: bool) -> BendingResponse {
        let measure = self.measure(positions, normals);
        if self.fold != 0.0 {
            return measure.respond_folded(&self.law, &self.memory, self.fold, definite);
        }
        measure.respond(&self.law, &self.memory, definite)
    }

    /// Starts the memory at `positions` without friction.
    pub(crate) fn start(&mut self, positions: &[f64], normals: &[f64]) {
        self.memory.position = self.measure(positions, normals).curvature();
        self.memory.peak = self.memory.position.abs();
    }

    pub(crate) fn add_forces(&self, positions: &[f64], normals: &[f64], forces: &mut [f64]) {
        let moment = self.respond(positions, normals, false).gradient;
        for &WeightedNode { node, weight } in &self.nodes {
            add_at(forces, node, scale(moment, -self.area * weight));
        }
    }

    pub(crate) fn potential(&self, positions: &[f64], normals: &[f64]) -> f64 {
        self.area * self.respond(positions, normals, false).energy
    }

    pub(crate) fn add_stiffness(
        &self,
        positions: &[f64],
        normals: &[f64],
        definite: bool,
        put: &mut impl FnMut([u32; 2], Matrix),
    ) {
        let hessian = self.respond(positions, normals, definite).hessian;
        for (k, &WeightedNode { node, weight }) in self.nodes.iter().enumerate() {
            for second in &self.nodes[k..] {
                put([node, second.node], sum([(self.area * weight * second.weight, hessian)]));
            }
        }
    }

    pub(crate) fn commit(&mut self, positions: &[f64], normals: &[f64]) -> f64 {
        let curvature = self.measure(positions, normals).curvature();
        self.area * commit_memory(&self.law, &mut self.memory, curvature)
    }
}
