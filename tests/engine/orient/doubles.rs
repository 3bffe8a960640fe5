//! One dot is one point, in whatever order photos and names come.

use std::collections::{BTreeMap, BTreeSet};

use super::orientation::camcal;
use super::seeded::dots::target;
use sightline::adjust::{adjust, apply};
use sightline::adjustment::{AdjustOptions, Adjustment, Advice};
use sightline::matching::{MatchOptions, PhotoTargets, match_uncoded};
use sightline::orient::{Note, orient};
use sightline::project::{Parameter, Project};

/// The sheet with the names of its four codes and a few dots; all dots are targets.
struct Sheet {
    project: Project,
    targets: Vec<PhotoTargets>,
    truth: BTreeMap<(String, u64), String>,
}

fn sheet() -> Option<Sheet> {
    let mut project = camcal(Some(7.3))?;
    let mut targets: Vec<PhotoTargets> =
        project.photos.iter().map(|p| PhotoTargets { photo: p.id.clone(), targets: Vec::new() }).collect();
    let mut truth = BTreeMap::new();
    for o in &project.observations {
        let photo = targets.iter_mut().find(|t| t.photo == o.photo).expect("its photo");
        photo.targets.push(target(o.u, o.v));
        truth.insert((o.photo.clone(), o.u.to_bits()), o.point.clone());
    }
    let is_named = |id: &str| id.len() == 4 || id.parse::<usize>().is_ok_and(|k| k % 7 == 3);
    project.observations.retain(|o| is_named(&o.point));
    project.points.retain(|p| is_named(&p.id));
    // The sheet is paper: by the photos its corners are not in a plane to better than some millimetres of its edge of a metre.
    // As exact coordinates they disagree (below).
    project.points.iter_mut().filter(|p| p.xyz.is_some()).for_each(|p| p.sigma = Some([Some(0.002); 3]));
    Some(Sheet { project, targets, truth })
}

/// Orients the document from its names, matches, takes what was found into the document, and adjusts.
fn step(document: &mut Project, targets: &[PhotoTargets]) -> (Adjustment, Vec<Note>) {
    let oriented = orient(document).expect("a sound document").project;
    let adjusted = adjust(&oriented, &AdjustOptions::default(), &mut |_| true).expect("solvable");
    let matching = match_uncoded(&apply(&oriented, &adjusted), targets, &MatchOptions::default()).expect("valid");
    for point in matching.points {
        document.points.push(sightline::project::Point { xyz: None, ..point });
    }
    document.observations.extend(matching.observations);
    let oriented = orient(document).expect("a sound document");
    let adjustment = adjust(&oriented.project, &AdjustOptions::default(), &mut |_| true).expect("solvable");
    (adjustment, oriented.notes)
}

#[test]
fn photos_that_come_later_show_the_same_points() {
    let Some(sheet) = sheet() else { return };
    for first in [["1", "6", "11", "16"], ["2", "9", "13", "20"], ["3", "4", "12", "18"]] {
        let mut document = sheet.project.clone();
        document.observations.retain(|o| first.contains(&o.photo.as_str()));
        document.photos.iter_mut().for_each(|p| p.enabled = first.contains(&p.id.as_str()));
        let (adjustment, _) = step(&mut document, &sheet.targets);
        println!("{first:?}: {} points from four photos", adjustment.points.len());
        document.photos.iter_mut().for_each(|p| p.enabled = true);
        // What is named in them are the four codes, in one plane.
        let later = sheet.project.observations.iter();
        let later = later.filter(|o| !first.contains(&o.photo.as_str()) && o.point.len() == 4);
        document.observations.extend(later.cloned());
        let (adjustment, notes) = step(&mut document, &sheet.targets);
        let mut names: BTreeMap<&str, BTreeSet<&str>> = BTreeMap::new();
        let mut mixed = 0;
        for point in &document.points {
            let own = document.observations.iter().filter(|o| o.point == point.id);
            let own: BTreeSet<&str> = own.map(|o| sheet.truth[&(o.photo.clone(), o.u.to_bits())].as_str()).collect();
            mixed += usize::from(own.len() > 1);
            for dot in own {
                names.entry(dot).or_default().insert(&point.id);
            }
        }
        let doubles = names.values().filter(|points| points.len() > 1).count();
        let c = adjustment.cameras[0].camera.interior.get(Parameter::C).expect("a value");
        println!(
            "{first:?}: {} points of 101 dots, {doubles} double, {mixed} mixed, {} photos, {} left out, c {c:.4}, sigma0 {:?}",
            document.points.len(),
            adjustment.photos.len(),
            adjustment.left_out.len(),
            adjustment.sigma0
        );
        assert_eq!((doubles, mixed, adjustment.photos.len()), (0, 0, 21), "{first:?}");
        assert!((97..=101).contains(&document.points.len()), "{first:?}");
        assert!(!adjustment.advice.iter().any(|a| matches!(a, Advice::DoublePoints { .. })), "{first:?}");
        let apart = notes.iter().any(|n| matches!(n, Note::PhotoNotOriented { .. } | Note::DoublePoints { .. }));
        assert!(!apart, "{first:?}: {notes:?}");
        assert!((c - 7.457).abs() < 0.005, "{first:?}: c {c}");
    }
}
