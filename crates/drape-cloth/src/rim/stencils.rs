use drape_fabric::{LANES, Lanes};

use crate::bend::{Bend, Bows};
use crate::field::{Batch, lanes, set, some_lanes};
use crate::panel::Yarns;
use crate::rim::Stencils;

/// What a batch of stencils is measured from.
pub(crate) struct Bowed {
    bows: [[Lanes; 3]; 2],
    normals: [Lanes; 3],
}

impl Bowed {
    /// The bows `$\sum b_i x_i$` of the stencils from a place on along both yarns, and the normals at their middles.
    #[inline(always)]
    pub(crate) fn of(
        stencils: &Stencils,
        start: usize,
        (positions, normals): (&[f64], &[f64]),
    ) -> Self {
        let mut bowed = Self { bows: [[[0.0; LANES]; 3]; 2], normals: [[0.0; LANES]; 3] };
        for lane in 0..LANES {
            let place = start + lane;
            let mut sums = [[0.0; 3]; 2];
            for part in stencils.parts(place) {
                let position = &positions[3 * part.node as usize..][..3];
                for (sum, weight) in sums.iter_mut().zip(part.weights) {
                    sum.iter_mut().zip(position).for_each(|(sum, x)| *sum += weight * x);
                }
            }
            for (bows, sum) in bowed.bows.iter_mut().zip(sums) {
                set(bows, lane, sum);
            }
            let normal = &normals[3 * stencils.middles[place] as usize..][..3];
            set(&mut bowed.normals, lane, [normal[0], normal[1], normal[2]]);
        }
        bowed
    }

    /// The stencils from a place on as bending connectors of one direction.
    #[inline(always)]
    pub(crate) fn bend<'a>(
        &'a self,
        yarns: &'a Yarns,
        (stencils, start, direction): (&'a Stencils, usize, usize),
    ) -> Bend<'a> {
        Bend {
            yarns,
            bows: Bows(self.bows[direction]),
            normals: Batch(self.normals.each_ref()),
            areas: lanes(&stencils.areas[direction], start),
            folds: some_lanes(&stencils.folds[direction], start),
        }
    }
}
