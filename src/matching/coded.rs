//! Names coded targets, once their family is known.

use std::collections::{BTreeMap, BTreeSet};

use serde::{Deserialize, Serialize};

use super::{Doubt, Doubtful, PhotoTargets, observed};
use crate::detection::Target;
use crate::project::{Observation, Point};
use crate::ring_code::Family;

/// Result of the codes.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Coded {
    /// The points, ascending by code; the identifier is the code's number.
    pub points: Vec<Point>,
    /// Their observations, photo by photo in the order given.
    pub observations: Vec<Observation>,
    /// Targets whose code occurs more than once in their photo: at most one of them can be right. And rings whose family is
    /// not known.
    pub doubtful: Vec<Doubtful>,
    /// The family whose codes were taken: the one asked for, or the only one that explains every ring of every photo.
    #[serde(default)]
    pub family: Option<Family>,
    /// The families that explain every ring. Several: the user has to choose. None although rings were read: they are of
    /// different families.
    #[serde(default)]
    pub families: Vec<Family>,
}

/// Code of a target's ring in a family.
enum FamilyReading {
    Safe(u32),
    Doubtful,
    Nothing,
}

fn reading(target: &Target, family: Family) -> FamilyReading {
    match target.code_in(family) {
        Some(number) => FamilyReading::Safe(number),
        None if target.code_candidates.iter().any(|c| c.family == family) => FamilyReading::Doubtful,
        None => FamilyReading::Nothing,
    }
}

/// The families that read, or leave in doubt, every ring that any family reads safely, one at least safely, and the number of such rings.
fn explaining(photos: &[PhotoTargets]) -> (Vec<Family>, usize) {
    let safe = |target: &&Target| target.code.is_some() || target.code_candidates.iter().any(|c| c.margin > 0.0);
    let rings: Vec<&Target> = photos.iter().flat_map(|photo| &photo.targets).filter(safe).collect();
    let safely =
        |ring: &Target| ring.code_candidates.iter().filter(|c| c.margin > 0.0).map(|c| c.family).collect::<Vec<_>>();
    let named: BTreeSet<Family> =
        rings.iter().flat_map(|ring| ring.code_family.into_iter().chain(safely(ring))).collect();
    let explains = |family: &Family| rings.iter().all(|ring| !matches!(reading(ring, *family), FamilyReading::Nothing));
    (named.into_iter().filter(explains).collect(), rings.len())
}

/// Points and observations of the coded targets, with the family that alone explains the rings of all photos together, or with
/// the one that is asked for.
///
/// A code that occurs more than once in a photo names none of its targets there, and that of a target which is occluded in part is asked
/// for: it is the user's choice whether so rough a centre is of use. A point is listed once it has an
/// observation, even a single one: the later steps report what is missing.
pub fn name_coded(photos: &[PhotoTargets], family: Option<Family>) -> Coded {
    let (families, rings) = explaining(photos);
    let single = if let [family] = families[..] { Some(family) } else { None };
    let taken = family.or(single);
    let mut coded = Coded { family: taken, families, ..Coded::default() };
    // numbers of targets without a family are used as they are
    let bare = photos
        .iter()
        .flat_map(|photo| &photo.targets)
        .all(|target| target.code_family.is_none() && target.code_candidates.is_empty());
    let number = |target: &Target| match taken {
        Some(family) => match reading(target, family) {
            FamilyReading::Safe(number) => Some(number),
            _ => None,
        },
        None => target.code.filter(|_| bare),
    };
    let mut codes: BTreeMap<u32, ()> = BTreeMap::new();
    for photo in photos {
        let mut count: BTreeMap<u32, usize> = BTreeMap::new();
        for code in photo.targets.iter().filter_map(number) {
            *count.entry(code).or_default() += 1;
        }
        for target in &photo.targets {
            let doubt = |points: Vec<String>, reason| Doubtful {
                photo: photo.photo.clone(),
                u: target.u,
                v: target.v,
                target: target.number(),
                points,
                reason,
            };
            let Some(code) = number(target) else {
                if rings > 0 && taken.is_none() && (target.code.is_some() || !target.code_candidates.is_empty()) {
                    coded.doubtful.push(doubt(Vec::new(), Doubt::CodeFamily));
                } else if taken.is_some_and(|family| matches!(reading(target, family), FamilyReading::Doubtful)) {
                    let mine = target.code_candidates.iter().filter(|c| Some(c.family) == taken);
                    coded.doubtful.push(doubt(mine.map(|c| c.number.to_string()).collect(), Doubt::CodeUnclear));
                }
                continue;
            };
            let point = code.to_string();
            if target.occluded {
                coded.doubtful.push(doubt(vec![point], Doubt::Occluded));
                continue;
            }
            if count[&code] > 1 {
                coded.doubtful.push(doubt(vec![point], Doubt::DuplicateCode));
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
    use crate::detection::{CodeCandidate, CodeNote};
    use crate::matching::target;
    #[test]
    fn a_code_of_an_occluded_target_is_asked_for() {
        let seen = vec![target(10.0, 5.0, Some(7)), Target { occluded: true, ..target(30.0, 5.0, Some(8)) }];
        let coded = name_coded(&[PhotoTargets { photo: "a".into(), targets: seen }], None);
        assert_eq!(coded.observations.iter().map(|o| o.point.as_str()).collect::<Vec<_>>(), ["7"]);
        let asked = coded.doubtful.iter().map(|d| (d.points.join(" "), d.reason)).collect::<Vec<_>>();
        assert_eq!(asked, [("8".to_owned(), Doubt::Occluded)]);
    }

    #[test]
    fn codes_name_targets_and_duplicates_are_doubtful() {
        let photo = |id: &str, codes: &[Option<u32>]| PhotoTargets {
            photo: id.into(),
            targets: codes.iter().enumerate().map(|(k, c)| target(10.0 * k as f64, 5.0, *c)).collect(),
        };
        let coded = name_coded(&[photo("a", &[Some(12), None, Some(3), Some(12)]), photo("b", &[Some(12)])], None);
        let ids: Vec<&str> = coded.points.iter().map(|p| p.id.as_str()).collect();
        assert_eq!(ids, ["3", "12"]);
        let seen: Vec<(&str, &str)> = coded.observations.iter().map(|o| (o.photo.as_str(), o.point.as_str())).collect();
        assert_eq!(seen, [("a", "3"), ("b", "12")]);
        assert_eq!(coded.doubtful.len(), 2);
        assert_eq!((coded.doubtful[1].u, coded.doubtful[1].reason), (30.0, Doubt::DuplicateCode));
    }

    fn ring(readings: &[(Family, u32, f64)]) -> Target {
        let candidate = |&(family, number, margin): &(Family, u32, f64)| CodeCandidate { family, number, margin };
        Target { code_candidates: readings.iter().map(candidate).collect(), ..target(1.0, 2.0, None) }
    }

    fn photos(rings: Vec<Vec<Target>>) -> Vec<PhotoTargets> {
        let photo = |(k, targets): (usize, Vec<Target>)| PhotoTargets { photo: k.to_string(), targets };
        rings.into_iter().enumerate().map(photo).collect()
    }

    #[test]
    fn the_rings_of_all_photos_together_show_their_family() {
        use Family::{Ring12, Ring20};
        // alone the first photo could be of two families; the second tells them apart, its last ring is half hidden
        let either = ring(&[(Ring12, 5, 0.9), (Ring20, 77, 0.9)]);
        let twelve = ring(&[(Ring12, 9, 0.8)]);
        let unclear = ring(&[(Ring12, 3, 0.0), (Ring12, 4, 0.0)]);
        let alone = name_coded(&photos(vec![vec![either.clone()]]), None);
        assert_eq!((alone.family, &alone.families[..]), (None, &[Ring12, Ring20][..]));
        assert_eq!((alone.observations.len(), alone.doubtful[0].reason), (0, Doubt::CodeFamily));
        let asked = name_coded(&photos(vec![vec![either.clone()]]), Some(Ring20));
        assert_eq!(asked.observations[0].point, "77");
        let together = name_coded(&photos(vec![vec![either.clone()], vec![twelve.clone(), unclear]]), None);
        assert_eq!((together.family, &together.families[..]), (Some(Ring12), &[Ring12][..]));
        let points: Vec<_> = together.observations.iter().map(|o| o.point.as_str()).collect();
        assert_eq!(points, ["5", "9"]);
        assert_eq!((together.doubtful.len(), together.doubtful[0].reason), (1, Doubt::CodeUnclear));
        assert_eq!(together.doubtful[0].points, ["3", "4"]);
    }

    #[test]
    fn a_family_in_which_every_ring_is_in_doubt_is_not_asked_about() {
        use Family::{Ring12, Ring20};
        let doubtful = [(Ring20, 70, 0.0), (Ring20, 77, 0.0)];
        let mut read = Target { code: Some(5), code_family: Some(Ring12), ..ring(&doubtful) };
        let alone = name_coded(&photos(vec![vec![read.clone()]]), None);
        assert_eq!((alone.family, &alone.families[..]), (Some(Ring12), &[Ring12][..]));
        // taken as one of 20 bits the ring is a question, and as one of 12 again a code
        read.quality.code_margin = Some(0.7);
        read.settle_code(Ring20);
        assert_eq!((read.code, read.code_family, read.quality.code_margin), (None, None, None));
        assert_eq!(read.quality.code_note, Some(CodeNote::OtherFamily));
        read.settle_code(Ring12);
        assert_eq!((read.code, read.code_family, read.quality.code_note), (Some(5), Some(Ring12), None));
        assert_eq!(read.quality.code_margin, Some(0.7));
    }

    #[test]
    fn rings_of_two_families_name_nothing_until_one_is_chosen() {
        let mixed = photos(vec![vec![ring(&[(Family::Ring12, 9, 0.8)])], vec![ring(&[(Family::Ring14, 9, 0.8)])]]);
        let coded = name_coded(&mixed, None);
        assert!(coded.family.is_none() && coded.families.is_empty() && coded.observations.is_empty());
        assert_eq!(coded.doubtful.len(), 2);
        let chosen = name_coded(&mixed, Some(Family::Ring14));
        assert_eq!(chosen.observations.len(), 1);
        assert_eq!(chosen.observations[0].photo, "1");
    }
}
