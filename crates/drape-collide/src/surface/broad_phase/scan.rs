//! Scan of a surface for pairs: trees over its triangles and edges, queried by runs of primitives.

use std::sync::atomic::{AtomicUsize, Ordering};

use rayon::prelude::*;

use super::body_boxes::BodyBoxes;
use super::query::Query;
use super::tree::{Bounds, Probe, Tree, array};
use crate::error::Error;
use crate::surface::geometry::{Run, WIDTH};
use crate::surface::pair::{Pair, PairKind};

/// Number of runs of primitives of a chunk, for one thread at a time.
///
/// It is constant, so that no result depends on the number of threads.
const CHUNK: usize = 64;

/// Trees and lists of a scan; they allocate only when they grow.
#[derive(Debug, Clone, Default)]
pub(crate) struct Scan {
    triangles: Tree,
    edges: Tree,
    chunks: Vec<Chunk>,
    body_vertices: BodyBoxes,
}

impl Scan {
    /// Finds the pairs that a query asks for, at most `capacity`. With `keeps_bodies` boxes of bodies
    /// are as they were in the last run.
    pub(crate) fn run(
        &mut self,
        query: &Query<'_>,
        capacity: usize,
        keeps_bodies: bool,
    ) -> Result<(), Error> {
        let primitives = query.primitives;
        let Scan { triangles, edges, chunks, body_vertices } = self;
        triangles.fit(&primitives.triangle_order, keeps_bodies, |triangle| {
            query.bounds(primitives.triangles[triangle as usize])
        });
        edges.fit(&primitives.edge_order, keeps_bodies, |edge| {
            query.bounds(primitives.edges[edge as usize])
        });
        let is_free = |vertex: u32| primitives.is_free(&[vertex]);
        let vertex_runs = primitives.vertex_runs.chunks(CHUNK);
        body_vertices.fit(vertex_runs, keeps_bodies, is_free, |vertex| query.bounds([vertex]));
        let free_triangles = triangles.free_bounds(&primitives.triangle_order);

        let vertex_chunks = primitives.vertex_runs.len().div_ceil(CHUNK);
        let edge_chunks = primitives.edge_runs.len().div_ceil(CHUNK);
        chunks.resize_with(vertex_chunks + edge_chunks, Chunk::default);
        let found = AtomicUsize::new(0);
        let scan = |(k, chunk): (usize, &mut Chunk)| {
            chunk.pairs.clear();
            let (kind, runs) = match k.checked_sub(vertex_chunks) {
                None => (PairKind::VertexFace, primitives.vertex_runs.chunks(CHUNK).nth(k)),
                Some(k) => (PairKind::EdgeEdge, primitives.edge_runs.chunks(CHUNK).nth(k)),
            };
            let runs = runs.unwrap_or_default();
            let has_pairs = match kind {
                PairKind::VertexFace => body_vertices.may_meet(k, &free_triangles),
                // Edges are paired with later ones.
                PairKind::EdgeEdge => {
                    runs.first().is_some_and(|run| Some(run.first) <= primitives.last_free_edge)
                }
            };
            if !has_pairs {
                return;
            }
            for &run in runs {
                let before = chunk.pairs.len();
                match kind {
                    PairKind::VertexFace => chunk.scan_vertices(query, triangles, run),
                    PairKind::EdgeEdge => chunk.scan_edges(query, edges, run),
                }
                let more = chunk.pairs.len() - before;
                if found.fetch_add(more, Ordering::Relaxed) + more > capacity {
                    // The sum only grows, so the call fails whichever thread comes first.
                    return;
                }
            }
        };
        // One by one: folds gather in few of them.
        chunks.par_iter_mut().enumerate().with_max_len(1).for_each(scan);
        if found.into_inner() > capacity {
            return Err(Error::TooManyPairs { capacity });
        }
        Ok(())
    }

    /// Pairs of the last run, sorted by kind and features, in parts.
    pub(crate) fn pairs(&self) -> impl Iterator<Item = &[Pair]> {
        self.chunks.iter().map(|chunk| &chunk.pairs[..])
    }
}

/// Runs of vertices or of edges, with the pairs in which they come first.
#[derive(Debug, Clone, Default)]
struct Chunk {
    /// Primitives whose boxes overlap that of each primitive of a run.
    near: [Vec<u32>; WIDTH],
    /// Sorted by features.
    pairs: Vec<Pair>,
}

impl Chunk {
    /// Finds the pairs of the vertices of a run with triangles.
    fn scan_vertices(&mut self, query: &Query<'_>, tree: &Tree, run: Run) {
        let primitives = query.primitives;
        let vertex = |k: usize| run.first + k as u32;
        let probe = Probe {
            bounds: array(run.count, Bounds::EMPTY, |k| query.bounds([vertex(k)])),
            only_free: !primitives.is_free(&[run.first]),
            after: None,
        };
        let class = array(run.count, 0, |k| primitives.seams.class(vertex(k)));
        self.near.iter_mut().for_each(Vec::clear);
        let order = &primitives.triangle_order;
        let (separations, seams) = (query.separations, &primitives.seams);
        tree.visit(order, &probe, |k, slot| {
            let triangle = order.items[slot];
            let corners = &primitives.triangles[triangle as usize];
            let classes = [&[class[k]][..], &primitives.triangle_classes[slot]];
            if !separations.exempt(seams, [&[vertex(k)], corners], classes) {
                self.near[k].push(triangle);
            }
        });
        for (k, near) in self.near[..run.count].iter_mut().enumerate() {
            near.sort_unstable();
            let pairs = near.iter().filter_map(|&triangle| {
                let [a, b, c] = primitives.triangles[triangle as usize];
                query.pair(PairKind::VertexFace, [vertex(k), triangle], [vertex(k), a, b, c])
            });
            self.pairs.extend(pairs);
        }
    }

    /// Finds the pairs of the edges of a run with later edges.
    fn scan_edges(&mut self, query: &Query<'_>, tree: &Tree, run: Run) {
        let primitives = query.primitives;
        let edge = |k: usize| run.first + k as u32;
        let ends = |k: usize| primitives.edges[run.first as usize + k];
        let probe = Probe {
            bounds: array(run.count, Bounds::EMPTY, |k| query.bounds(ends(k))),
            only_free: !primitives.is_free(&ends(0)),
            after: Some(run.first),
        };
        let classes = array(run.count, [0; 2], |k| ends(k).map(|end| primitives.seams.class(end)));
        self.near.iter_mut().for_each(Vec::clear);
        let order = &primitives.edge_order;
        let (separations, seams) = (query.separations, &primitives.seams);
        tree.visit(order, &probe, |k, slot| {
            let other = order.items[slot];
            if other <= edge(k) {
                return;
            }
            let vertices = [&ends(k)[..], &primitives.edges[other as usize]];
            let classes = [&classes[k][..], &primitives.edge_classes[slot]];
            if !separations.exempt(seams, vertices, classes) {
                self.near[k].push(other);
            }
        });
        for (k, near) in self.near[..run.count].iter_mut().enumerate() {
            near.sort_unstable();
            let [a, b] = ends(k);
            let pairs = near.iter().filter_map(|&other| {
                let [c, d] = primitives.edges[other as usize];
                query.pair(PairKind::EdgeEdge, [edge(k), other], [a, b, c, d])
            });
            self.pairs.extend(pairs);
        }
    }
}
