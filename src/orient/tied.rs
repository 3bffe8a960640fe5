//! Points whose rays intersect at two positions, equally many at each. One name was given to two targets, and it is undecided which of
//! them it belongs to. Such a point is not determined; the user is asked.

use crate::initial::intersection::{Ray, intersect};

use super::block::{NEAR_A_PAIR, OrientationBlock, pairs_of};

/// Where more than one point in so many is tied it is poses that are wrong, and not names; so many are names in any case.
const FEW: usize = 10;
const ANY: usize = 3;

/// The observations of a point that support each of two positions; `None` if one place has more of them.
pub(super) fn sides(block: &OrientationBlock, point: usize) -> Option<[Vec<usize>; 2]> {
    let (which, rays) = block.rays(point);
    if rays.len() < 4 {
        return None;
    }
    let tolerance: Vec<f64> = which.iter().map(|&s| block.tolerance_px(block.observations[s].photo)).collect();
    let mut sets: Vec<Vec<usize>> = Vec::new();
    for [a, b] in pairs_of(rays.len()) {
        let Some(set) = meeting(&rays, &tolerance, [a, b]) else { continue };
        if !sets.contains(&set) {
            sets.push(set);
        }
    }
    let most = sets.iter().map(Vec::len).max()?;
    sets.retain(|set| set.len() == most);
    let first = sets.iter().find_map(|a| {
        let apart = sets.iter().find(|b| !a.iter().any(|k| b.contains(k)))?;
        Some([a, apart].map(|set| set.iter().map(|&k| which[k]).collect()))
    });
    first.filter(|_| most >= 2)
}

/// The rays that meet where two of them do.
fn meeting(rays: &[Ray], tolerance: &[f64], pair: [usize; 2]) -> Option<Vec<usize>> {
    let of = |set: &[usize]| intersect(&set.iter().map(|&k| rays[k]).collect::<Vec<_>>()).ok();
    let seed = of(&pair)?.point;
    let excess = |at, k: usize| rays[k].pose.misfit(&at, rays[k].image) * rays[k].weight.sqrt() / tolerance[k];
    if pair.iter().any(|&k| !(excess(seed, k) <= 1.0)) {
        return None;
    }
    let mut set: Vec<usize> = (0..rays.len()).filter(|&k| excess(seed, k) <= NEAR_A_PAIR).collect();
    loop {
        let found = of(&set)?.point;
        let worst = (0..set.len()).max_by(|&i, &j| excess(found, set[i]).total_cmp(&excess(found, set[j])))?;
        if excess(found, set[worst]) <= 1.0 {
            return Some(set);
        }
        set.remove(worst);
        if set.len() < 2 {
            return None;
        }
    }
}

/// Takes the coordinates of tied points back; given ones decide by themselves.
pub(super) fn release(block: &mut OrientationBlock) {
    let open = |point: &usize| !(block.anchored && block.points[*point].known.is_some());
    // Only of points that many of their rays disagree with.
    let disputed = |point: &usize| {
        let block_point = &block.points[*point];
        let compared = block_point.observations.iter().filter(|&&s| block.misfit_px(s).is_some());
        let (all, agreeing) = compared.fold((0, 0), |(n, m), &s| (n + 1, m + usize::from(block.observations[s].taken)));
        all >= 4 && 2 * agreeing <= all
    };
    let compared = (0..block.points.len()).filter(|&point| block.points[point].xyz.is_some());
    let tied: Vec<usize> =
        compared.clone().filter(open).filter(disputed).filter(|&point| sides(block, point).is_some()).collect();
    if tied.len() > ANY.max(compared.count() / FEW) {
        return;
    }
    for point in tied {
        block.points[point].xyz = None;
    }
}
