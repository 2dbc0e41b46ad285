use crate::course::Sweep;
use crate::error::Error;
use crate::order::Run;
use crate::pair::{Pair, PairKind, closest, distance};
use crate::pairs::CandidatePairs;
use crate::surface::Surface;
use crate::tree::{Bounds, Probe, Tree, WIDTH};
use crate::vector::{Vector, add, at, subtract};
use rayon::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering};

/// CandidatePairs that a list may hold unless told otherwise.
///
/// A hundred for each of half a million vertices, and 4 GB: more is a mistake of the input.
const CAPACITY: usize = 50_000_000;

/// Runs of primitives that one thread looks after at a time.
///
/// A constant, so that no result depends on the number of threads.
const CHUNK: usize = 64;

/// Smallest activation distance of a pair that lies close at rest, in m: a thousand times the rounding of
/// coordinates of 1 m, and far below any cloth.
const LEAST: f64 = 1e-9;

/// Squared sine of the angle below which two edges count as parallel: 1.8° (Li et al. 2020,
/// "Incremental Potential Contact", eq. 24).
const PARALLEL: f64 = 1e-3;

/// Two primitives of a group that lie close at rest, with their distances.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Close {
    key: (PairKind, [u32; 2]),
    activation_distance: f64,
    min_separation: f64,
}

/// Finds all pairs of primitives that are near each other.
///
/// It keeps boxes and lists between calls and allocates only when they grow; it may be used for
/// one surface after another.
#[derive(Debug, Clone)]
pub struct Detector {
    triangles: Tree,
    edges: Tree,
    chunks: Vec<Chunk>,
    pairs: CandidatePairs,
    capacity: usize,
}

impl Default for Detector {
    fn default() -> Detector {
        Detector {
            triangles: Tree::default(),
            edges: Tree::default(),
            chunks: Vec::new(),
            pairs: CandidatePairs::default(),
            capacity: CAPACITY,
        }
    }
}

impl Detector {
    /// A detector whose list may hold so many pairs, instead of 50 million.
    pub fn with_capacity(capacity: usize) -> Detector {
        Detector { capacity, ..Detector::default() }
    }

    /// The pairs of the last detection that succeeded.
    pub fn pairs(&self) -> &CandidatePairs {
        &self.pairs
    }

    /// Finds every pair whose distance is below its activation_distance plus a margin in m, at flat positions.
    ///
    /// Left out are pairs that share a vertex, directly or through what is sewn, and pairs without a free
    /// vertex. On an error the pairs of the detection before stay.
    ///
    /// # Errors
    ///
    /// If there are not three coordinates for each vertex, one is not finite or beyond 1000 km,
    /// the margin is not a positive number, or the list would be too long.
    pub fn detect(
        &mut self,
        surface: &Surface,
        positions: &[f64],
        margin: f64,
    ) -> Result<&CandidatePairs, Error> {
        self.detect_swept(surface, (positions, Sweep::Still), margin)
    }

    /// Finds every pair whose distance falls below its activation_distance plus a margin in m somewhere on a
    /// course from flat positions, and perhaps some that stay a little farther.
    ///
    /// # Errors
    ///
    /// As of [`detect`](Detector::detect).
    pub fn detect_swept(
        &mut self,
        surface: &Surface,
        (positions, course): (&[f64], Sweep<'_>),
        margin: f64,
    ) -> Result<&CandidatePairs, Error> {
        surface.check_positions(positions)?;
        if let Some(ways) = course.ways() {
            surface.check_positions(ways)?;
        }
        crate::error::check("the margin of contact (m)", margin, "above 0", margin > 0.0)?;
        let drift = course.drift(surface.free_count());
        let query = Query { surface, positions, limit: Limit::Margin(margin, course), drift };
        self.scan(&query)?;
        let found = self.chunks.iter().map(|chunk| &chunk.pairs[..]);
        self.pairs.replace(found, (positions, course), (margin, surface.free_count()));
        Ok(&self.pairs)
    }

    /// Moves the pairs along their course to where it comes nearest to flat positions, from where a
    /// [`CcdFilter`](crate::CcdFilter) then takes further steps.
    pub fn follow(&mut self, positions: &[f64]) {
        self.pairs.follow(positions);
    }

    /// Drops the pairs, for their distances are no longer those to keep.
    pub(crate) fn forget(&mut self) {
        self.pairs = CandidatePairs::default();
    }

    /// Leaves what the query asks for in the chunks.
    fn scan(&mut self, query: &Query<'_>) -> Result<(), Error> {
        let surface = query.surface;
        let Detector { triangles, edges, chunks, .. } = self;
        triangles.fit(&surface.triangle_order, |triangle| {
            query.bounds(surface.triangles()[triangle as usize])
        });
        edges.fit(&surface.edge_order, |edge| query.bounds(surface.edges()[edge as usize]));

        let vertex_chunks = surface.vertex_runs.len().div_ceil(CHUNK);
        let edge_chunks = surface.edge_runs.len().div_ceil(CHUNK);
        chunks.resize_with(vertex_chunks + edge_chunks, Chunk::default);
        let (found, capacity) = (AtomicUsize::new(0), self.capacity);
        let scan = |(k, chunk): (usize, &mut Chunk)| {
            chunk.pairs.clear();
            let (kind, runs) = match k.checked_sub(vertex_chunks) {
                None => (PairKind::VertexFace, surface.vertex_runs.chunks(CHUNK).nth(k)),
                Some(k) => (PairKind::EdgeEdge, surface.edge_runs.chunks(CHUNK).nth(k)),
            };
            for &run in runs.unwrap_or_default() {
                let before = chunk.pairs.len();
                match kind {
                    PairKind::VertexFace => chunk.scan_vertices(query, triangles, run),
                    PairKind::EdgeEdge => chunk.scan_edges(query, edges, run),
                }
                let more = chunk.pairs.len() - before;
                if found.fetch_add(more, Ordering::Relaxed) + more > capacity {
                    // The sum only grows, so whoever comes first, the call fails.
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
}

/// CandidatePairs of primitives that lie close at rest, within twice their activation_distance.
///
/// They push below half of their distance at rest, so a fine mesh does not push itself apart, and
/// keep a quarter.
pub(crate) fn close_at_rest(surface: &Surface, rest: &[f64]) -> Result<Vec<Close>, Error> {
    let mut detector = Detector::default();
    let query = Query { surface, positions: rest, limit: Limit::Rest, drift: [0.0; 3] };
    detector.scan(&query)?;
    let mut close = Vec::new();
    for pair in detector.chunks.iter().flat_map(|chunk| &chunk.pairs) {
        let activation_distance = pair.activation_distance.min(0.5 * pair.distance);
        let min_separation = pair.min_separation.min(0.25 * pair.distance);
        // Written so that NaN fails.
        if !(min_separation >= LEAST) {
            return Err(Error::ContactAtRest {
                vertices: pair.vertices,
                distance: pair.distance,
                least: 4.0 * LEAST,
            });
        }
        close.push(Close { key: pair.key(), activation_distance, min_separation });
    }
    Ok(close)
}

/// How near two primitives must be.
#[derive(Debug, Clone, Copy)]
enum Limit<'a> {
    /// Below their activation_distance and so much more in m, somewhere on a course.
    Margin(f64, Sweep<'a>),
    /// Below twice their activation_distance, and of one group.
    Rest,
}

/// What is asked for.
struct Query<'a> {
    surface: &'a Surface,
    positions: &'a [f64],
    limit: Limit<'a>,
    /// Taken off all ways, in m: it brings no two primitives nearer.
    drift: Vector,
}

impl Query<'_> {
    fn bounds<const N: usize>(&self, vertices: [u32; N]) -> Bounds {
        let skin = self.surface.group_distances()[self.surface.group(vertices[0]) as usize];
        let places = vertices.map(|vertex| at(self.positions, vertex as usize));
        // Half of how near two must be, in each of two boxes that then overlap.
        match self.limit {
            Limit::Rest => Bounds::around(places, 2.0 * skin.activation_distance),
            Limit::Margin(margin, course) => {
                let around = skin.activation_distance + 0.5 * margin;
                let Some(ways) = course.ways() else { return Bounds::around(places, around) };
                let way = |vertex: u32| subtract(at(ways, vertex as usize), self.drift);
                let ends = places.into_iter().zip(vertices);
                let ends = ends.map(|(place, vertex)| add(place, way(vertex)));
                Bounds::around(places.into_iter().chain(ends), around)
            }
        }
    }

    /// The pair of two primitives that share no vertex, if they are near enough.
    fn pair(&self, kind: PairKind, features: [u32; 2], vertices: [u32; 4]) -> Option<Pair> {
        let surface = self.surface;
        let other = match kind {
            PairKind::VertexFace => vertices[1],
            PairKind::EdgeEdge => vertices[2],
        };
        let mut skin = surface.pair_distances(vertices[0], other);
        let same_group = surface.group(vertices[0]) == surface.group(other);
        let places = vertices.map(|vertex| at(self.positions, vertex as usize));
        let distance = distance(&closest(kind, places));
        // How much nearer the two can come on their course.
        let mut nearer = 0.0;
        let limit = match self.limit {
            Limit::Margin(margin, course) => {
                nearer = course.approach(kind, vertices);
                skin.activation_distance + margin + nearer
            }
            Limit::Rest if same_group => 2.0 * skin.activation_distance,
            Limit::Rest => return None,
        };
        if !(distance < limit) {
            return None;
        }
        if same_group && !surface.close.is_empty() {
            let close = &surface.close;
            if let Ok(place) = close.binary_search_by_key(&(kind, features), |close| close.key) {
                let Close { activation_distance, min_separation, .. } = close[place];
                (skin.activation_distance, skin.min_separation) =
                    (surface.grown * activation_distance, surface.grown * min_separation);
                if let Limit::Margin(margin, _) = self.limit
                    && !(distance < skin.activation_distance + margin + nearer)
                {
                    return None;
                }
            }
        }
        skin.min_separation *= surface.share(&vertices)?;
        let [a, b] = features.map(|feature| feature as usize);
        let (area, parallel) = match kind {
            PairKind::VertexFace => (surface.vertex_face_area(a, b), 0.0),
            PairKind::EdgeEdge => {
                let lengths = surface.edge_length_squared(a) * surface.edge_length_squared(b);
                (surface.edge_edge_area(a, b), PARALLEL * lengths)
            }
        };
        let (activation_distance, min_separation) = (skin.activation_distance, skin.min_separation);
        let distance = distance - nearer;
        Some(Pair {
            kind,
            features,
            vertices,
            activation_distance,
            min_separation,
            area,
            parallel,
            distance,
        })
    }
}

/// Some runs of vertices or of edges with the pairs in which they come first.
#[derive(Debug, Clone, Default)]
struct Chunk {
    /// The primitives that may be near each of the run at hand.
    near: [Vec<u32>; WIDTH],
    /// Sorted by features.
    pairs: Vec<Pair>,
}

impl Chunk {
    fn scan_vertices(&mut self, query: &Query<'_>, tree: &Tree, run: Run) {
        let surface = query.surface;
        let vertex = |k: usize| run.first + k as u32;
        let probe = Probe {
            bounds: array(run.count, Bounds::EMPTY, |k| query.bounds([vertex(k)])),
            only_free: !surface.is_free(&[run.first]),
            after: None,
        };
        let class = array(run.count, 0, |k| surface.sewn.class(vertex(k)));
        self.near.iter_mut().for_each(Vec::clear);
        let order = &surface.triangle_order;
        tree.visit(order, &probe, |k, slot| {
            if !surface.sewn.joins(&[class[k]], &surface.triangle_classes[slot]) {
                self.near[k].push(order.items[slot]);
            }
        });
        for (k, near) in self.near[..run.count].iter_mut().enumerate() {
            near.sort_unstable();
            let pairs = near.iter().filter_map(|&triangle| {
                let [a, b, c] = surface.triangles()[triangle as usize];
                query.pair(PairKind::VertexFace, [vertex(k), triangle], [vertex(k), a, b, c])
            });
            self.pairs.extend(pairs);
        }
    }

    fn scan_edges(&mut self, query: &Query<'_>, tree: &Tree, run: Run) {
        let surface = query.surface;
        let edge = |k: usize| run.first + k as u32;
        let ends = |k: usize| surface.edges()[run.first as usize + k];
        let probe = Probe {
            bounds: array(run.count, Bounds::EMPTY, |k| query.bounds(ends(k))),
            only_free: !surface.is_free(&ends(0)),
            after: Some(run.first),
        };
        let classes = array(run.count, [0; 2], |k| ends(k).map(|end| surface.sewn.class(end)));
        self.near.iter_mut().for_each(Vec::clear);
        let order = &surface.edge_order;
        tree.visit(order, &probe, |k, slot| {
            let other = order.items[slot];
            if other > edge(k) && !surface.sewn.joins(&classes[k], &surface.edge_classes[slot]) {
                self.near[k].push(other);
            }
        });
        for (k, near) in self.near[..run.count].iter_mut().enumerate() {
            near.sort_unstable();
            let [a, b] = ends(k);
            let pairs = near.iter().filter_map(|&other| {
                let [c, d] = surface.edges()[other as usize];
                query.pair(PairKind::EdgeEdge, [edge(k), other], [a, b, c, d])
            });
            self.pairs.extend(pairs);
        }
    }
}

/// The first few from a function, and the rest alike.
pub(crate) fn array<T: Copy>(count: usize, rest: T, item: impl Fn(usize) -> T) -> [T; WIDTH] {
    std::array::from_fn(|k| if k < count { item(k) } else { rest })
}
