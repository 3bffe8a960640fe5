//! Photos that were withdrawn may have been all that held a model together. What is left of it then are groups that share no point:
//! the place of one in the system of the other means nothing any more, and no adjustment finds it.

use std::collections::{BTreeMap, HashMap};

use super::block::OrientationBlock;
use crate::project::Project;

/// Sets the smaller groups of a free model apart, largest first; none while all hang together. The project is what the block makes
/// of it. Given coordinates and poses tie groups by themselves.
pub(super) fn split(block: &mut OrientationBlock, project: &Project) -> Vec<OrientationBlock> {
    if block.anchored || block.photos.iter().any(|block_photo| block_photo.given) {
        return Vec::new();
    }
    let mut groups = groups(block, project);
    groups.sort_by_key(|group| (std::cmp::Reverse(group.len()), group[0]));
    let apart: Vec<OrientationBlock> = groups.iter().skip(1).map(|group| alone(block, group)).collect();
    if let (Some(largest), false) = (groups.first(), apart.is_empty()) {
        *block = alone(block, largest);
        block.review();
    }
    apart
}

/// The photos with poses, in groups that common points join.
fn groups(block: &OrientationBlock, project: &Project) -> Vec<Vec<usize>> {
    let photo_at: HashMap<&str, usize> = project.photos.iter().enumerate().map(|(k, p)| (p.id.as_str(), k)).collect();
    let mut group: Vec<usize> = (0..block.photos.len()).collect();
    let mut first: HashMap<&str, usize> = HashMap::new();
    for observation in project.observations.iter().filter(|o| o.enabled) {
        let photo = photo_at[observation.photo.as_str()];
        let other = *first.entry(&observation.point).or_insert(photo);
        let (a, b) = (group[photo].min(group[other]), group[photo].max(group[other]));
        if a < b {
            group.iter_mut().filter(|g| **g == b).for_each(|g| *g = a);
        }
    }
    let mut groups: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for photo in (0..group.len()).filter(|&k| block.photos[k].pose.is_some()) {
        groups.entry(group[photo]).or_default().push(photo);
    }
    groups.into_values().collect()
}

/// The block with the poses of some photos only, and the points that these determine.
fn alone(block: &OrientationBlock, photos: &[usize]) -> OrientationBlock {
    let mut part = block.clone();
    for (k, block_photo) in part.photos.iter_mut().enumerate() {
        block_photo.pose = block_photo.pose.filter(|_| photos.contains(&k));
    }
    for point in 0..part.points.len() {
        if part.rays(point).0.len() < 2 {
            part.points[point].xyz = None;
        }
    }
    part
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::initial::Pose;
    use crate::project::{Camera, Interior, Observation, Photo, Point, Sigma};
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    #[test]
    fn what_shares_no_point_is_set_apart_unless_something_is_given() {
        let camera = Camera::new("k", 3000, 2000, Interior::brown(3000.0));
        let mut project = Project { cameras: vec![camera], ..Project::default() };
        // b, d and e hang together over two points, a and c over a third; f shares one that is disabled.
        let seen = [("b", "p"), ("d", "p"), ("d", "q"), ("e", "q"), ("a", "r"), ("c", "r"), ("f", "r")];
        for id in ["a", "b", "c", "d", "e", "f"] {
            project.photos.push(Photo { id: id.into(), camera: "k".into(), enabled: true, ..Photo::default() });
        }
        project.points.extend(["p", "q", "r"].map(|id| Point { id: id.into(), ..Point::default() }));
        for (photo, point) in seen {
            let (enabled, sigma) = (photo != "f", Sigma::One(0.1));
            let (photo, point) = (photo.into(), point.into());
            project.observations.push(Observation { photo, point, u: 0.0, v: 0.0, sigma, enabled, target: None });
        }
        let mut block = OrientationBlock::new(&project);
        block.photos.iter_mut().take(5).for_each(|block_photo| block_photo.pose = Some(Pose::identity()));
        let posed =
            |block: &OrientationBlock| -> Vec<usize> { (0..6).filter(|&k| block.photos[k].pose.is_some()).collect() };
        let mut tied = OrientationBlock { anchored: true, ..block.clone() };
        assert!(split(&mut tied, &project).is_empty());
        assert_eq!(posed(&tied), [0, 1, 2, 3, 4]);
        let apart = split(&mut block, &project);
        assert_eq!(posed(&block), [1, 3, 4]);
        assert_eq!(apart.iter().map(posed).collect::<Vec<_>>(), [vec![0, 2]]);
        assert!(split(&mut block, &project).is_empty());
    }
}
