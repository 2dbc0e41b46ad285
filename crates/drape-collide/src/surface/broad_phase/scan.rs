//! Scan of a surface for pairs: runs of primitives query trees over its triangles and edges.

use std::sync::atomic::{AtomicUsize, Ordering};

use super::body_boxes::BodyBoxes;
use super::query::PairQuery;
use super::tree::{Bounds, BoxTree, Probe, fill_lanes};
use crate::error::Error;
use crate::surface::geometry::{PrimitiveRun, WIDTH};
use crate::surface::pair::{Pair, PairKind};
use crate::threads::*;

/// Number of primitive runs in a chunk, which one thread handles at a time.
///
/// The number is constant, so no result depends on the number of threads.
const CHUNK: usize = 64;

/// Trees and lists of a scan, which allocate memory only when they grow.
#[derive(Debug, Clone, Default)]
pub(crate) struct PairScan {
    triangles: BoxTree,
    edges: BoxTree,
    chunks: Vec<PairChunk>,
    body_vertices: BodyBoxes,
}

/// Scan whose boxes have been fitted to positions.
struct FittedScan<'a> {
    query: &'a PairQuery<'a>,
    triangles: &'a BoxTree,
    edges: &'a BoxTree,
    body_vertices: &'a BodyBoxes,
    /// Box around all free triangles.
    free_triangles: Bounds,
    /// Number of chunks of vertices, which come before the chunks of edges.
    vertex_chunk_count: usize,
    capacity: usize,
    /// Number of pairs that all threads have found.
    pair_count: AtomicUsize,
}

impl PairScan {
    /// Finds the pairs of `query`, at most `capacity`. With `keeps_bodies`, the boxes of bodies
    /// from the last run are still valid.
    pub(crate) fn run(
        &mut self,
        query: &PairQuery<'_>,
        capacity: usize,
        keeps_bodies: bool,
    ) -> Result<(), Error> {
        let primitives = query.primitives;
        let PairScan { triangles, edges, chunks, body_vertices } = self;
        triangles.fit(&primitives.triangle_order, keeps_bodies, |triangle| {
            query.bounds(primitives.triangles[triangle as usize])
        });
        edges.fit(&primitives.edge_order, keeps_bodies, |edge| {
            query.bounds(primitives.edges[edge as usize])
        });
        body_vertices.fit(
            primitives.vertex_runs.chunks(CHUNK),
            keeps_bodies,
            |vertex| primitives.is_free(&[vertex]),
            |vertex| query.bounds([vertex]),
        );

        let vertex_chunk_count = primitives.vertex_runs.len().div_ceil(CHUNK);
        let edge_chunk_count = primitives.edge_runs.len().div_ceil(CHUNK);
        chunks.resize_with(vertex_chunk_count + edge_chunk_count, PairChunk::default);
        let fitted = FittedScan {
            query,
            free_triangles: triangles.free_bounds(&primitives.triangle_order),
            triangles,
            edges,
            body_vertices,
            vertex_chunk_count,
            capacity,
            pair_count: AtomicUsize::new(0),
        };
        // Neighbouring chunks are scanned by different threads, because folds gather in few chunks.
        chunks
            .par_iter_mut()
            .enumerate()
            .with_max_len(1)
            .for_each(|(k, chunk)| fitted.scan_chunk(k, chunk));
        if fitted.pair_count.into_inner() > capacity {
            return Err(Error::TooManyPairs { capacity });
        }
        Ok(())
    }

    /// Returns the pairs of the last run in consecutive lists, sorted by [`Pair::key`].
    pub(crate) fn pairs(&self) -> impl Iterator<Item = &[Pair]> {
        self.chunks.iter().map(|chunk| &chunk.pairs[..])
    }
}

impl FittedScan<'_> {
    /// Finds the pairs of chunk number `k` and writes them to `chunk`.
    fn scan_chunk(&self, k: usize, chunk: &mut PairChunk) {
        chunk.pairs.clear();
        let primitives = self.query.primitives;
        let (kind, runs) = match k.checked_sub(self.vertex_chunk_count) {
            None => (PairKind::VertexFace, primitives.vertex_runs.chunks(CHUNK).nth(k)),
            Some(k) => (PairKind::EdgeEdge, primitives.edge_runs.chunks(CHUNK).nth(k)),
        };
        let runs = runs.unwrap_or_default();
        let may_have_pairs = match kind {
            PairKind::VertexFace => self.body_vertices.may_meet(k, &self.free_triangles),
            // Edges are paired with later edges only.
            PairKind::EdgeEdge => {
                runs.first().is_some_and(|run| Some(run.first) <= primitives.last_free_edge)
            }
        };
        if !may_have_pairs {
            return;
        }

        for &run in runs {
            let before = chunk.pairs.len();
            match kind {
                PairKind::VertexFace => chunk.scan_vertices(self.query, self.triangles, run),
                PairKind::EdgeEdge => chunk.scan_edges(self.query, self.edges, run),
            }
            let added = chunk.pairs.len() - before;
            if self.pair_count.fetch_add(added, Ordering::Relaxed) + added > self.capacity {
                // The sum only grows, so the run fails whichever thread comes first.
                return;
            }
        }
    }
}

/// Runs of vertices or of edges, with the pairs in which they come first.
#[derive(Debug, Clone, Default)]
struct PairChunk {
    /// For each primitive of a run, the primitives whose boxes overlap its box.
    near: [Vec<u32>; WIDTH],
    /// Pairs, sorted by features.
    pairs: Vec<Pair>,
}

impl PairChunk {
    /// Adds the pairs of `query` between the vertices of `run` and triangles in `tree`.
    fn scan_vertices(&mut self, query: &PairQuery<'_>, tree: &BoxTree, run: PrimitiveRun) {
        let primitives = query.primitives;
        let vertices = fill_lanes(run.count, 0, |k| run.first + k as u32);
        let probe = Probe {
            bounds: fill_lanes(run.count, Bounds::EMPTY, |k| query.bounds([vertices[k]])),
            only_free: !primitives.is_free(&[run.first]),
            after: None,
        };

        // Triangles with overlapping boxes that are not exempt.
        let class = vertices.map(|vertex| primitives.seams.class(vertex));
        self.near.iter_mut().for_each(Vec::clear);
        let order = &primitives.triangle_order;
        let (separations, seams) = (query.separations, &primitives.seams);
        tree.visit(order, &probe, |k, slot| {
            let triangle = order.items[slot];
            let corners = &primitives.triangles[triangle as usize];
            let classes = [&[class[k]][..], &primitives.triangle_classes[slot]];
            if !separations.exempt(seams, [&[vertices[k]], corners], classes) {
                self.near[k].push(triangle);
            }
        });

        // The order of visits depends on the tree, the order of pairs must not.
        for (&vertex, near) in vertices.iter().zip(&mut self.near[..run.count]) {
            near.sort_unstable();
            let pairs = near.iter().filter_map(|&triangle| {
                let [a, b, c] = primitives.triangles[triangle as usize];
                query.pair(PairKind::VertexFace, [vertex, triangle], [vertex, a, b, c])
            });
            self.pairs.extend(pairs);
        }
    }

    /// Adds the pairs of `query` between the edges of `run` and later edges in `tree`.
    fn scan_edges(&mut self, query: &PairQuery<'_>, tree: &BoxTree, run: PrimitiveRun) {
        let primitives = query.primitives;
        let edges = fill_lanes(run.count, 0, |k| run.first + k as u32);
        let ends = edges.map(|edge| primitives.edges[edge as usize]);
        let probe = Probe {
            bounds: fill_lanes(run.count, Bounds::EMPTY, |k| query.bounds(ends[k])),
            only_free: !primitives.is_free(&ends[0]),
            after: Some(run.first),
        };

        // Later edges with overlapping boxes that are not exempt.
        let classes = ends.map(|ends| ends.map(|end| primitives.seams.class(end)));
        self.near.iter_mut().for_each(Vec::clear);
        let order = &primitives.edge_order;
        let (separations, seams) = (query.separations, &primitives.seams);
        tree.visit(order, &probe, |k, slot| {
            let candidate = order.items[slot];
            if candidate <= edges[k] {
                return;
            }
            let vertices = [&ends[k][..], &primitives.edges[candidate as usize]];
            let classes = [&classes[k][..], &primitives.edge_classes[slot]];
            if !separations.exempt(seams, vertices, classes) {
                self.near[k].push(candidate);
            }
        });

        // The order of visits depends on the tree, the order of pairs must not.
        for (k, near) in self.near[..run.count].iter_mut().enumerate() {
            near.sort_unstable();
            let [a, b] = ends[k];
            let pairs = near.iter().filter_map(|&candidate| {
                let [c, d] = primitives.edges[candidate as usize];
                query.pair(PairKind::EdgeEdge, [edges[k], candidate], [a, b, c, d])
            });
            self.pairs.extend(pairs);
        }
    }
}
