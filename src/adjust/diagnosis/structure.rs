//! Rank defects that follow from the structure of a network without its numbers: a datum for every connected group of photos.

use std::collections::BTreeMap;

use crate::adjust::datum::free;
use crate::adjust::problem::network::Network;
use crate::adjust::problem::state::State;
use crate::error::{Defect, Error, Result};
use crate::project::{DatumKind, Project};

/// Identifier in the document.
pub fn photo_id(project: &Project, network: &Network, photo: usize) -> String {
    project.photos[network.photos[photo].index].id.clone()
}

/// Identifier in the document.
pub fn point_id(project: &Project, network: &Network, point: usize) -> String {
    project.points[network.points[point].index].id.clone()
}

/// Defects that the structure alone shows.
///
/// # Errors
/// [`Error::RankDefect`].
pub fn structure(project: &Project, network: &Network, state: &State) -> Result<()> {
    let groups = groups(network, 1);
    let controlled = network.datum == DatumKind::Control;
    if groups.len() == 1 {
        let missing = if controlled { free::missing_control(network, state) } else { 0 };
        return if missing == 0 {
            Ok(())
        } else {
            Err(Error::RankDefect { defects: vec![Defect::NoDatum { missing }] })
        };
    }
    if controlled {
        let whole = free::missing_control(network, state);
        let lacking = groups.iter().map(|group| missing_in_group(network, state, group)).max().unwrap_or(0);
        if lacking == 0 {
            return Ok(());
        }
        if whole > 0 {
            return Err(Error::RankDefect {
                defects: vec![Defect::NoDatum { missing: whole }, not_tied(project, network, &groups)],
            });
        }
    }
    Err(Error::RankDefect { defects: vec![not_tied(project, network, &groups)] })
}

/// Groups of photos that are not tied to each other.
pub fn not_tied(project: &Project, network: &Network, groups: &[Vec<usize>]) -> Defect {
    let named = |group: &Vec<usize>| group.iter().map(|p| photo_id(project, network, *p)).collect();
    Defect::NotTied { groups: groups.iter().map(named).collect() }
}

fn missing_in_group(network: &Network, state: &State, group: &[usize]) -> usize {
    let mut part = network.clone();
    for (k, photo) in part.photos.iter_mut().enumerate().filter(|(k, _)| !group.contains(k)) {
        let _ = k;
        photo.prior = Default::default();
    }
    for point in &mut part.points {
        if !network.rays[point.rays.clone()].iter().any(|ray| group.contains(&ray.photo)) {
            (point.fixed, point.prior) = (Default::default(), Default::default());
        }
    }
    let measured = |p: usize| network.rays[part.points[p].rays.clone()].iter().any(|r| group.contains(&r.photo));
    let bars = network.bars.iter().filter(|bar| measured(bar.from) && measured(bar.to)).cloned().collect();
    part.bars = bars;
    free::missing_control(&part, state)
}

/// Photos connected by pairs that share at least `shared` points.
pub fn groups(network: &Network, shared: usize) -> Vec<Vec<usize>> {
    let n = network.photos.len();
    let mut parent: Vec<usize> = (0..n).collect();
    fn root(parent: &mut [usize], mut a: usize) -> usize {
        while parent[a] != a {
            parent[a] = parent[parent[a]];
            a = parent[a];
        }
        a
    }
    let mut common: BTreeMap<(usize, usize), usize> = BTreeMap::new();
    for point in &network.points {
        let rays = &network.rays[point.rays.clone()];
        if shared == 1 {
            for pair in rays.windows(2) {
                let (a, b) = (root(&mut parent, pair[0].photo), root(&mut parent, pair[1].photo));
                parent[a.max(b)] = a.min(b);
            }
        } else {
            for (k, a) in rays.iter().enumerate() {
                for b in &rays[..k] {
                    *common.entry((a.photo.min(b.photo), a.photo.max(b.photo))).or_default() += 1;
                }
            }
        }
    }
    for ((a, b), _) in common.into_iter().filter(|(_, count)| *count >= shared) {
        let (a, b) = (root(&mut parent, a), root(&mut parent, b));
        parent[a.max(b)] = a.min(b);
    }
    for bar in network.bars.iter().filter(|_| shared == 1) {
        let first = |point: usize| network.rays[network.points[point].rays.clone()].first().map(|r| r.photo);
        if let (Some(a), Some(b)) = (first(bar.from), first(bar.to)) {
            let (a, b) = (root(&mut parent, a), root(&mut parent, b));
            parent[a.max(b)] = a.min(b);
        }
    }
    let mut groups: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for photo in 0..n {
        groups.entry(root(&mut parent, photo)).or_default().push(photo);
    }
    groups.into_values().collect()
}
