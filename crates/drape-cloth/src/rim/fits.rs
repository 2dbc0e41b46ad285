//! Fits of a panel: the nodes and weights of its stencils, and of the derivatives for its normals.

use crate::layout::connectors::BendingConnectors;
use crate::measure::vector::Vector;
use crate::panel::fold::WeightedPoint;
use crate::panel::lattice::Lattice;
use crate::rim::neighbourhood::Neighbourhoods;
use crate::rim::quadratic_fit::QuadraticFit;

/// Node of a stencil.
#[derive(Debug, Clone, Copy)]
pub(crate) struct StencilNode {
    pub(crate) node: u32,
    /// Weights in the second derivatives along warp and weft, in 1/m².
    pub(crate) weights: [f64; 2],
}

/// Stencil of a fit, with its areas and folds.
#[derive(Debug, Clone)]
pub(crate) struct FittedStencil {
    pub(crate) middle: u32,
    /// Nodes in rising order.
    pub(crate) nodes: Vec<StencilNode>,
    /// Areas along warp and weft, in m².
    pub(crate) areas: [f64; 2],
    /// Rest curvatures that folds add along warp and weft, in 1/m.
    pub(crate) folds: [f64; 2],
}

/// Weights of the first derivatives of positions along warp and weft at a particle.
#[derive(Debug, Clone)]
pub(crate) struct SurfaceTangents {
    pub(crate) particle: u32,
    nodes: Vec<u32>,
    weights: [Vec<f64>; 2],
}

/// Fits of a panel: one about each node that is not the middle of a triple along both yarns.
pub(crate) struct PanelFits {
    /// Stencils with an area.
    pub(crate) stencils: Vec<FittedStencil>,
    /// Derivatives at all nodes with a fit.
    pub(crate) tangents: Vec<SurfaceTangents>,
}

impl PanelFits {
    /// Returns the fits of `lattice`, with its particles counted from 0.
    pub(crate) fn new(
        lattice: &Lattice,
        neighbourhoods: &Neighbourhoods<'_>,
        bending: &[BendingConnectors; 2],
    ) -> Self {
        let spacings = lattice.spacings();
        let (mut stencils, mut tangents) = (Vec::new(), Vec::new());
        for middle in 0..lattice.coordinates.len() as u32 {
            let at = middle as usize;
            if bending.iter().all(|direction| direction.is_middle[at]) {
                continue;
            }

            // The fit uses as many of the nearest nodes as it needs.
            let mut nodes = neighbourhoods.around(middle);
            let points: Vec<_> =
                nodes.iter().map(|&node| lattice.coordinates[node as usize]).collect();
            let fit = QuadraticFit::new(&points, spacings[at]);
            nodes.truncate(fit.first[0].len());

            // Nodes with an area have a stencil of second derivatives.
            let areas = [0, 1].map(|direction| bending[direction].stencil_areas[at]);
            if areas.iter().any(|&area| area > 0.0) {
                let [weft, warp] = &fit.second;
                let weights = warp.iter().zip(weft).map(|(&warp, &weft)| [warp, weft]);
                let nodes = nodes.iter().zip(weights);
                let mut nodes: Vec<StencilNode> =
                    nodes.map(|(&node, weights)| StencilNode { node, weights }).collect();
                nodes.sort_by_key(|node| node.node);
                let folds = [0, 1].map(|direction| {
                    let weighted = nodes.iter().map(|node| WeightedPoint {
                        coordinates: lattice.coordinates[node.node as usize],
                        weight: node.weights[direction],
                    });
                    let curvatures = lattice.folds.iter().map(|fold| {
                        fold.rest_curvature(weighted.clone(), points[0], direction, lattice.spacing)
                    });
                    curvatures.sum()
                });
                stencils.push(FittedStencil { middle, nodes, areas, folds });
            }

            let [weft, warp] = fit.first;
            tangents.push(SurfaceTangents { particle: middle, nodes, weights: [warp, weft] });
        }
        Self { stencils, tangents }
    }
}

impl SurfaceTangents {
    /// Moves the particles, counted from 0, to count from `first` on.
    pub(crate) fn shift(&mut self, first: u32) {
        self.particle += first;
        self.nodes.iter_mut().for_each(|node| *node += first);
    }

    /// Returns the derivatives of `positions` along warp and weft.
    pub(crate) fn at(&self, positions: &[f64]) -> [Vector; 2] {
        self.weights.each_ref().map(|weights| {
            let mut sum = [0.0; 3];
            for (&node, weight) in self.nodes.iter().zip(weights) {
                let position = &positions[3 * node as usize..][..3];
                sum.iter_mut().zip(position).for_each(|(sum, x)| *sum += weight * x);
            }
            sum
        })
    }
}
