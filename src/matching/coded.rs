//! Coded targets name themselves.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::{Doubt, Doubtful, PhotoTargets, observed};
use crate::project::{Observation, Point};

/// What the codes say.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Coded {
    /// The points, ascending by code; the identifier is the code's number.
    pub points: Vec<Point>,
    /// Their observations, photo by photo in the order given.
    pub observations: Vec<Observation>,
    /// Targets whose code occurs more than once in their photo: at most one of them can be right.
    pub doubtful: Vec<Doubtful>,
}

/// Points and observations of the coded targets.
///
/// A code that occurs more than once in a photo names none of its targets there. A point is listed once it has an
/// observation, even a single one: the later steps say what is missing.
pub fn name_coded(photos: &[PhotoTargets]) -> Coded {
    let mut coded = Coded::default();
    let mut codes: BTreeMap<u32, ()> = BTreeMap::new();
    for photo in photos {
        let mut count: BTreeMap<u32, usize> = BTreeMap::new();
        for code in photo.targets.iter().filter_map(|t| t.code) {
            *count.entry(code).or_default() += 1;
        }
        for target in &photo.targets {
            let Some(code) = target.code else { continue };
            let point = code.to_string();
            if count[&code] > 1 {
                coded.doubtful.push(Doubtful {
                    photo: photo.photo.clone(),
                    u: target.u,
                    v: target.v,
                    target: target.number(),
                    points: vec![point],
                    reason: Doubt::DuplicateCode,
                });
                continue;
            }
            codes.insert(code, ());
            coded.observations.push(observed(&photo.photo, &point, target));
        }
    }
    coded.points = codes.keys().map(|code| Point { id: code.to_string(), ..Point::default() }).collect();
    coded
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::matching::target;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    #[test]
    fn codes_name_targets_and_duplicates_are_doubtful() {
        let photo = |id: &str, codes: &[Option<u32>]| PhotoTargets {
            photo: id.into(),
            targets: codes.iter().enumerate().map(|(k, c)| target(10.0 * k as f64, 5.0, *c)).collect(),
        };
        let coded = name_coded(&[photo("a", &[Some(12), None, Some(3), Some(12)]), photo("b", &[Some(12)])]);
        let ids: Vec<&str> = coded.points.iter().map(|p| p.id.as_str()).collect();
        assert_eq!(ids, ["3", "12"]);
        let seen: Vec<(&str, &str)> = coded.observations.iter().map(|o| (o.photo.as_str(), o.point.as_str())).collect();
        assert_eq!(seen, [("a", "3"), ("b", "12")]);
        assert_eq!(coded.doubtful.len(), 2);
        assert_eq!((coded.doubtful[1].u, coded.doubtful[1].reason), (30.0, Doubt::DuplicateCode));
    }
}
