//! Position of every block in the reduced normal equations: photos in an order that keeps the factor thin, then kept
//! points, then interior orientations that many photos share.
//!
//! No block crosses the border of a tile, so that every pair of blocks lies in one tile; the gaps hold a unit diagonal.
//! Orders are compared by the tile products of the factorisation they lead to, and the cheapest is taken: a dense network
//! keeps its own order, a strip or a ring is renumbered (reverse Cuthill-McKee, or minimum degree).

use crate::adjust::linear::kernel::TILE;
use crate::adjust::linear::tiles::TilePattern;
use crate::adjust::problem::network::Network;

/// Places of the blocks.
#[derive(Clone, Debug)]
pub struct Layout {
    /// First index of every photo.
    pub photo: Vec<usize>,
    /// First index of every interior orientation.
    pub interior: Vec<usize>,
    /// First index of every point that is kept; `usize::MAX` for eliminated points.
    pub point: Vec<usize>,
    /// Length of the vectors, gaps included.
    pub size: usize,
    /// Tiles of the factor.
    pub pattern: TilePattern,
}

/// Chooses an order, sorts the network's rays by it and returns the places.
pub fn layout(network: &mut Network) -> Layout {
    let neighbours = neighbours(network);
    let orders = [(0..network.photos.len()).collect(), cuthill_mckee(&neighbours), minimum_degree(&neighbours)];
    let candidates = orders.iter().map(|order| place(network, &neighbours, order));
    let best = candidates.min_by_key(|layout| layout.pattern.cost());
    let layout = best.unwrap_or_else(|| place(network, &neighbours, &[]));
    for point in &network.points {
        network.rays[point.rays.clone()].sort_by_key(|ray| layout.photo[ray.photo]);
    }
    layout
}

/// Photos that share an eliminated point or are of one rig, ascending, without the photo itself.
fn neighbours(network: &Network) -> Vec<Vec<usize>> {
    let n = network.photos.len();
    let mut shared = vec![false; n * n];
    for point in network.points.iter().filter(|p| !p.kept) {
        for a in &network.rays[point.rays.clone()] {
            for b in &network.rays[point.rays.clone()] {
                shared[a.photo * n + b.photo] = true;
            }
        }
    }
    // The mean of a camera's relative poses ties all its exposures.
    for member in &network.rig {
        let photos = || member.exposures.iter().flat_map(|(_, photos)| *photos);
        photos().for_each(|a| photos().for_each(|b| shared[a * n + b] = true));
    }
    (0..n).map(|a| (0..n).filter(|b| *b != a && shared[a * n + b]).collect()).collect()
}

/// Reverse Cuthill-McKee (A. George, J. Liu 1981), every component from a photo far from the others.
fn cuthill_mckee(neighbours: &[Vec<usize>]) -> Vec<usize> {
    let n = neighbours.len();
    let mut order = Vec::with_capacity(n);
    let mut placed = vec![false; n];
    let walk = |start: usize, placed: &mut Vec<bool>| {
        let mut queue = vec![start];
        placed[start] = true;
        let mut head = 0;
        while let Some(&at) = queue.get(head) {
            head += 1;
            let mut next: Vec<usize> = neighbours[at].iter().copied().filter(|b| !placed[*b]).collect();
            next.sort_by_key(|b| neighbours[*b].len());
            for b in next {
                placed[b] = true;
                queue.push(b);
            }
        }
        queue
    };
    while order.len() < n {
        let fewest = (0..n).filter(|a| !placed[*a]).min_by_key(|a| neighbours[*a].len());
        let Some(mut start) = fewest else { break };
        for _ in 0..2 {
            start = walk(start, &mut placed.clone()).last().copied().unwrap_or(start);
        }
        order.extend(walk(start, &mut placed));
    }
    order.reverse();
    order
}

/// Minimum degree: the photo with the fewest remaining neighbours first, its neighbours then know each other.
fn minimum_degree(neighbours: &[Vec<usize>]) -> Vec<usize> {
    let n = neighbours.len();
    let mut knows = vec![false; n * n];
    for (a, list) in neighbours.iter().enumerate() {
        list.iter().for_each(|&b| knows[a * n + b] = true);
    }
    let mut degree: Vec<usize> = neighbours.iter().map(Vec::len).collect();
    let mut left = vec![true; n];
    let mut order = Vec::with_capacity(n);
    while let Some(next) = (0..n).filter(|a| left[*a]).min_by_key(|a| degree[*a]) {
        left[next] = false;
        order.push(next);
        let around: Vec<usize> = (0..n).filter(|b| left[*b] && knows[next * n + b]).collect();
        for &a in &around {
            degree[a] -= 1;
            for &b in &around {
                if a != b && !knows[a * n + b] {
                    knows[a * n + b] = true;
                    degree[a] += 1;
                }
            }
        }
        if around.len() == n - order.len() {
            // The rest all know each other: any order will do.
            order.extend(around.iter().copied());
            break;
        }
    }
    order
}

fn place(network: &Network, neighbours: &[Vec<usize>], order: &[usize]) -> Layout {
    let mut size = 0;
    let mut next = |length: usize| {
        if size % TILE + length > TILE {
            size = size.next_multiple_of(TILE);
        }
        size += length;
        size - length
    };
    let room = network.interior_size();
    let mut photo = vec![0; network.photos.len()];
    let mut interior = vec![usize::MAX; network.interiors.len()];
    for &p in order {
        photo[p] = next(6);
        let own = network.photos[p].interior;
        if network.interiors[own].photo.is_some() {
            interior[own] = next(room);
        }
    }
    let point: Vec<usize> = network.points.iter().map(|p| if p.kept { next(3) } else { usize::MAX }).collect();
    for place in interior.iter_mut().filter(|place| **place == usize::MAX) {
        *place = next(room);
    }
    let size = size.next_multiple_of(TILE).max(TILE);

    let side = size / TILE;
    let mut present = vec![false; side * side];
    let mut join = |a: usize, b: usize| {
        // Interior orientations without unknowns may come last.
        if a.max(b) < size {
            present[a.max(b) / TILE * side + a.min(b) / TILE] = true;
        }
    };
    for (a, list) in neighbours.iter().enumerate() {
        let own = network.photos[a].interior;
        join(photo[a], interior[own]);
        for &b in list {
            let other = network.photos[b].interior;
            join(photo[a], photo[b]);
            join(photo[a], interior[other]);
            join(interior[own], interior[other]);
        }
    }
    for (block, &at) in network.points.iter().zip(&point).filter(|(block, _)| block.kept) {
        for ray in &network.rays[block.rays.clone()] {
            join(at, photo[ray.photo]);
            join(at, interior[network.photos[ray.photo].interior]);
        }
    }
    for bar in &network.bars {
        join(point[bar.from], point[bar.to]);
    }
    let tiles = (0..side * side).filter(|k| present[*k]).map(|k| (k / side, k % side));
    Layout { photo, interior, point, size, pattern: TilePattern::new(side, tiles.collect::<Vec<_>>().into_iter()) }
}

#[cfg(test)]
mod tests {
    use super::*;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    /// A ring of photos, numbered at random, each with three neighbours on either side.
    fn ring(n: usize) -> Vec<Vec<usize>> {
        let number = |k: usize| k * 37 % n;
        let mut neighbours = vec![Vec::new(); n];
        for k in 0..n {
            neighbours[number(k)] =
                (1..=3).flat_map(|d| [number((k + d) % n), number((k + n - d) % n)]).collect::<Vec<_>>();
        }
        neighbours
    }

    #[test]
    fn orders_are_permutations_that_keep_neighbours_close() {
        let neighbours = ring(100);
        for order in [cuthill_mckee(&neighbours), minimum_degree(&neighbours)] {
            let mut sorted = order.clone();
            sorted.sort_unstable();
            assert!(sorted.into_iter().eq(0..100));
        }
        let order = cuthill_mckee(&neighbours);
        let mut place = vec![0; 100];
        order.iter().enumerate().for_each(|(k, a)| place[*a] = k);
        let width = neighbours.iter().enumerate().flat_map(|(a, list)| list.iter().map(move |b| (a, *b)));
        let width = width.map(|(a, b)| place[a].abs_diff(place[b])).max();
        assert!(width <= Some(9), "a folded ring has twice the band of a strip: {width:?}");
    }
}
