//! One advice per cause: photos and points with the same note, and parameters of one camera, are grouped.

use std::mem::{Discriminant, discriminant};

use sightline::adjustment::{Advice, CorrelatedPair, CorrelationGroup, Criteria, correlation_groups};
use sightline::orient::{Note, PhotoReason, PointReason};
use sightline::project::Parameter;

use super::{Item, Target, correlated_name, note_item, parameter_name};
use crate::format;
use crate::i18n::{first, name_list, text};

/// Common reason of notes that are shown as one item.
#[derive(PartialEq)]
enum NoteReason {
    Photo(Discriminant<PhotoReason>),
    Point(Discriminant<PointReason>),
}

fn cause(note: &Note) -> Option<(NoteReason, &str)> {
    match note {
        Note::PhotoNotOriented { photo, reason } => Some((NoteReason::Photo(discriminant(reason)), photo)),
        Note::PointNotDetermined { point, reason } => Some((NoteReason::Point(discriminant(reason)), point)),
        _ => None,
    }
}

/// Items of notes, in their order; those with one cause are one, at the place of the first.
pub fn note_items<'a>(notes: impl Iterator<Item = &'a Note>, unit: &str) -> Vec<Item> {
    let mut items: Vec<(Option<NoteReason>, Vec<&str>, Item)> = Vec::new();
    for note in notes {
        let Some((cause, name)) = cause(note) else {
            items.extend(note_item(note, unit).map(|item| (None, Vec::new(), item)));
            continue;
        };
        match items.iter_mut().find(|(of, ..)| of.as_ref() == Some(&cause)) {
            Some((_, names, _)) => names.push(name),
            None => items.extend(note_item(note, unit).map(|item| (Some(cause), vec![name], item))),
        }
    }
    let told = |(cause, names, item): (Option<NoteReason>, Vec<&str>, Item)| match cause {
        Some(cause) if names.len() > 1 => {
            let all = name_list(names.iter().copied());
            let (title, evidence) = match cause {
                NoteReason::Photo(_) => (first::photos_not_oriented(names.len(), all), text::n_photos(names.len())),
                NoteReason::Point(_) => (first::points_not_determined(names.len(), all), text::n_points(names.len())),
            };
            Item { title, evidence, ..item }
        }
        _ => item,
    };
    items.into_iter().map(told).collect()
}

/// Parameters of distortion that are not significantly different from 0, an item a camera: the finest is held first, since the others may be significant
/// without it.
pub fn insignificant(advice: &[Advice]) -> Vec<Item> {
    let mut cameras: Vec<(&str, Vec<(Parameter, f64)>)> = Vec::new();
    for one in advice {
        let Advice::Insignificant { camera, parameter, ratio, .. } = one else { continue };
        match cameras.iter_mut().find(|(of, _)| of == camera) {
            Some((_, all)) => all.push((*parameter, *ratio)),
            None => cameras.push((camera, vec![(*parameter, *ratio)])),
        }
    }
    let item = |(camera, mut all): (&str, Vec<(Parameter, f64)>)| {
        all.dedup_by_key(|(parameter, _)| *parameter);
        let (finest, _) = *all.last()?;
        if all.len() < 2 {
            return None;
        }
        let names = name_list(all.iter().map(|(parameter, _)| parameter_name(*parameter)));
        let ratios = all.iter().map(|(_, ratio)| format!("{} σ", format::fixed(*ratio, 1))).collect::<Vec<_>>();
        Some(Item {
            warning: true,
            title: first::insignificant(&names, camera),
            body: first::insignificant_body(parameter_name(finest)),
            evidence: ratios.join(", "),
            target: Target::Hold { camera: camera.to_owned(), parameter: finest },
        })
    };
    cameras.into_iter().filter_map(item).collect()
}

/// Whether a camera has several of them, so that [`insignificant`] shows them as one.
pub fn is_one_of_several(advice: &Advice, all: &[Advice]) -> bool {
    let Advice::Insignificant { camera, parameter, .. } = advice else { return false };
    let another = |other: &Advice| matches!(other, Advice::Insignificant { camera: of, parameter: which, .. } if of == camera && which != parameter);
    all.iter().any(another)
}

/// Correlations among the parameters of each camera, as one item a camera.
pub fn correlations(advice: &[Advice], criteria: &Criteria) -> Vec<Item> {
    let item = |CorrelationGroup { camera, pairs: all, hold, .. }: CorrelationGroup| {
        let CorrelatedPair { first: a, second: b, correlation: r } = all.first()?.clone();
        if all.len() < 2 {
            let one = advice
                .iter()
                .find(|one| matches!(one, Advice::HighCorrelation { camera: of, photo: None, .. } if *of == camera));
            return one.map(|one| super::network_item(one, criteria, ""));
        }
        let pairs = all
            .iter()
            .map(|p| format!("{} – {}", correlated_name(&p.first), correlated_name(&p.second)))
            .collect::<Vec<_>>();
        let target = hold.map_or(Target::None, |parameter| Target::Hold { camera: camera.clone(), parameter });
        Some(Item {
            warning: true,
            title: first::correlations(all.len(), &camera),
            body: first::correlations_body(name_list(pairs)),
            evidence: format!("{} – {} {}", correlated_name(&a), correlated_name(&b), format::fixed(r, 2)),
            target,
        })
    };
    correlation_groups(advice).into_iter().filter(|group| group.photo.is_none()).filter_map(item).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn photos_that_fail_for_one_reason_are_one_item_with_one_button() {
        let photo = |k: usize, reason| Note::PhotoNotOriented { photo: format!("p{k}"), reason };
        let mut notes: Vec<Note> = (0..17).map(|k| photo(k, PhotoReason::NoPoints)).collect();
        notes.push(photo(17, PhotoReason::Disagrees { determined: 4 }));
        notes.extend(
            (0..3).map(|k| Note::PointNotDetermined { point: k.to_string(), reason: PointReason::NotMeasured }),
        );
        let items = note_items(notes.iter(), "mm");
        assert_eq!(items.len(), 3);
        assert!(items[0].title.contains("17") && items[0].title.contains("p0, p1"), "{}", items[0].title);
        assert_eq!(items[0].target, Target::Photo("p0".into()));
        assert!(items.iter().all(|item| !item.target.buttons().is_empty()));
    }

    #[test]
    fn parameters_of_one_camera_are_one_item_and_the_finest_is_held() {
        let one = |camera: &str, parameter| Advice::Insignificant {
            camera: camera.into(),
            photo: None,
            parameter,
            ratio: 0.4,
            with: None,
            correlation: None,
        };
        let advice =
            [one("a", Parameter::K1), one("a", Parameter::K2), one("a", Parameter::K3), one("b", Parameter::P1)];
        let items = insignificant(&advice);
        assert_eq!(items.len(), 1);
        assert_eq!(items[0].target, Target::Hold { camera: "a".into(), parameter: Parameter::K3 });
        assert!(advice[..3].iter().all(|a| is_one_of_several(a, &advice)) && !is_one_of_several(&advice[3], &advice));
    }
}
