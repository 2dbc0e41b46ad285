//! Edges shorter than half a spacing are joined with a neighbour where the outline is smooth.

use crate::joints::{Joints, Link};
use crate::mistake::Mistake;
use crate::note::Note;
use crate::panel::Panel;
use crate::pattern::Pattern;

/// Largest turn at a joint that may be left without a node, in rad: 15 degrees. A chord across it cuts off
/// at most a fifteenth of its length.
const SMOOTH: f64 = std::f64::consts::PI / 12.0;

/// Shortest piece of outline between nodes, in spacings.
const SHORTEST: f64 = 0.5;

/// An end of a side of a link.
#[derive(Clone, Copy)]
struct LinkEnd {
    link: usize,
    side: usize,
    end: usize,
}

impl Joints {
    /// Joins short pieces with neighbours; what cannot be joined is a mistake.
    pub fn join_short(&mut self, pattern: &Pattern, spacing: f64) -> (Vec<Note>, Vec<Mistake>) {
        let shortest = SHORTEST * spacing * (1.0 - 1e-9);
        let mut notes = self.dissolve_runs(pattern, (shortest, spacing));
        loop {
            let mut short: Vec<(f64, usize)> = self
                .pieces_by_first()
                .into_iter()
                .map(|joint| (self.counted_after(joint), joint))
                .filter(|(length, _)| *length < shortest)
                .collect();
            short.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            let mut changed = false;
            for &(length, joint) in &short {
                // An earlier one of this pass may have joined it already.
                if self.joints[joint].removed || self.counted_after(joint) != length {
                    continue;
                }
                let ends = [joint, self.joints[joint].around[1]];
                let mut classes = ends.map(|j| self.joints[j].class).to_vec();
                classes.sort_by(|&a, &b| self.sharpest(a).total_cmp(&self.sharpest(b)));
                if let Some(&class) = classes.iter().find(|&&class| self.removable(class)) {
                    notes.extend(self.note(pattern, (joint, class), spacing));
                    self.remove(class);
                    changed = true;
                }
            }
            if !changed {
                let mistakes = short.iter().map(|&(length, joint)| {
                    let (panel, edge) = self.names(pattern, joint);
                    Mistake::ShortEdge { panel, edge, length, spacing }
                });
                return (notes, mistakes.collect());
            }
        }
    }

    /// Removes the smooth joints inside runs of short pieces, which digitised outlines are made of.
    fn dissolve_runs(&mut self, pattern: &Pattern, (shortest, spacing): (f64, f64)) -> Vec<Note> {
        let short: Vec<bool> =
            (0..self.joints.len()).map(|joint| self.counted_after(joint) < shortest).collect();
        let inside: Vec<usize> = (0..self.joints.len())
            .filter(|&joint| short[joint] && short[self.joints[joint].around[0]])
            .collect();
        let mut lost = vec![0; pattern.panels().len()];
        for joint in inside {
            let class = self.joints[joint].class;
            if !self.joints[joint].removed && self.removable(class) {
                self.class(class).for_each(|j| lost[self.joints[j].panel] += 1);
                self.remove(class);
            }
        }
        let panels = pattern.panels().iter().zip(lost).filter(|(_, ends)| *ends > 0);
        let note = |(panel, ends): (&Panel, usize)| Note::Dissolved {
            panel: panel.name().into(),
            ends,
            spacing,
        };
        panels.map(note).collect()
    }

    /// For each piece of outline between joints, or pair of pieces that are sewn together, the joint from
    /// which it goes on.
    fn pieces_by_first(&self) -> Vec<usize> {
        let first = |&joint: &usize| {
            let each = &self.joints[joint];
            let other_side = each.links[1].is_some_and(|link| {
                let link = &self.links[link];
                Self::foremost(link, 0) != joint
            });
            !each.removed && !other_side
        };
        (0..self.joints.len()).filter(first).collect()
    }

    fn class(&self, class: usize) -> impl Iterator<Item = usize> + '_ {
        self.classes[class].iter().copied().filter(|&j| !self.joints[j].removed)
    }

    fn sharpest(&self, class: usize) -> f64 {
        self.class(class).map(|j| self.joints[j].turn).fold(0.0, f64::max)
    }

    /// The end, at a joint, of the link beside it; of that before it with 0, after it with 1.
    fn end_at(&self, joint: usize, beside: usize) -> Option<LinkEnd> {
        let link = self.joints[joint].links[beside]?;
        let Link { ends, forward, .. } = &self.links[link];
        (0..2).find_map(|side| {
            let end = usize::from(forward[side] != (beside == 1));
            (ends[side][end] == joint).then_some(LinkEnd { link, side, end })
        })
    }

    /// The number of the link beside a joint, and the joint that this is sewn to by it.
    fn partner(&self, joint: usize, beside: usize) -> Option<(usize, usize)> {
        let LinkEnd { link, side, end } = self.end_at(joint, beside)?;
        Some((link, self.links[link].ends[1 - side][end]))
    }

    /// Whether all joints of a class can go: smooth, and sewn alike on both sides.
    fn removable(&self, class: usize) -> bool {
        self.sharpest(class) < SMOOTH
            && self.class(class).all(|joint| {
                let before = self.joints[joint].around[0];
                let alike = match (self.partner(joint, 0), self.partner(joint, 1)) {
                    (None, None) => true,
                    (Some((first, a)), Some((second, b))) => {
                        a == b && a != joint && first != second && self.same_sense(first, second)
                    }
                    _ => false,
                };
                // One joint at least stays on an outline.
                alike && before != joint
            })
    }

    fn same_sense(&self, first: usize, second: usize) -> bool {
        let sense = |link: &Link| link.forward[0] == link.forward[1];
        sense(&self.links[first]) == sense(&self.links[second])
    }

    fn remove(&mut self, class: usize) {
        let joints: Vec<usize> = self.class(class).collect();
        for joint in joints {
            // The joint on the other side may have merged them already.
            if let (Some(before), Some(after)) = (self.end_at(joint, 0), self.end_at(joint, 1))
                && before.link != after.link
            {
                self.merge(before, after);
            }
            let [before, after] = self.joints[joint].around;
            self.joints[before].around[1] = after;
            self.joints[after].around[0] = before;
            self.joints[joint].removed = true;
        }
    }

    /// Makes one link of two that end at a joint. The longer one grows: it keeps its stitch, its sides and
    /// its sense.
    fn merge(&mut self, one: LinkEnd, two: LinkEnd) {
        let two_longer = self.link_length(two.link) > self.link_length(one.link);
        let (kept, lost) = if two_longer { (two, one) } else { (one, two) };
        for other in 0..2 {
            // The far end of the lost link, on the joint's side and on the other.
            let far = self.links[lost.link].ends[lost.side ^ other][1 - lost.end];
            self.links[kept.link].ends[kept.side ^ other][kept.end] = far;
        }
        self.links[lost.link].removed = true;
        self.mark(kept.link);
    }

    fn link_length(&self, link: usize) -> f64 {
        self.length_after(Self::foremost(&self.links[link], 0))
    }

    /// What is said of a piece that loses an end, if that is the end of an edge.
    fn note(
        &self,
        pattern: &Pattern,
        (piece, class): (usize, usize),
        spacing: f64,
    ) -> Option<Note> {
        let after = self.joints[piece].around[1];
        let lost = if self.joints[piece].class == class { piece } else { after };
        self.joints[lost].edge?;
        let (panel, edge) = self.names(pattern, piece);
        let neighbour = if lost == piece { self.joints[piece].around[0] } else { after };
        let (_, with) = self.names(pattern, neighbour);
        let length = self.length_after(piece);
        (edge != with).then_some(Note::Joined { panel, edge, with, length, spacing })
    }

    /// The panel and the edge in the middle of the piece after a joint.
    fn names(&self, pattern: &Pattern, joint: usize) -> (String, String) {
        let Self { joints, starts, .. } = self;
        let number = joints[joint].panel;
        let middle = joints[joint].place + 0.5 * self.length_after(joint);
        let middle = middle % self.whole(number);
        let edge = starts[number].partition_point(|&s| s <= middle).max(1) - 1;
        let panel = &pattern.panels()[number];
        let edge = &panel.outline()[edge.min(panel.outline().len() - 1)];
        (panel.name().into(), edge.name.clone())
    }
}
