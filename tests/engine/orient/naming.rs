//! Uncoded targets of oriented photos: named where the geometry is sure, listed where it is not.

use std::collections::{BTreeMap, BTreeSet};

use super::orientation::{network, uniform};
use super::seeded::dots::target;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use sightline::matching::{MatchOptions, Matching, PhotoTargets, match_uncoded};
use sightline::project::{Point, Project};

/// A network of which `named` points keep their names; the other observations become bare targets among `clutter` more
/// per photo. Also what each bare target truly is, by photo and pixel.
struct Scene {
    project: Project,
    targets: Vec<PhotoTargets>,
    truth: BTreeMap<(String, u64), String>,
}

fn scene(seed: u64, photos: usize, points: usize, named: usize, clutter: usize) -> Scene {
    let mut project = network(seed, photos, points, 0.3, 0.05);
    let mut g = ChaCha8Rng::seed_from_u64(1000 + seed);
    let mut truth = BTreeMap::new();
    let mut targets: Vec<PhotoTargets> =
        project.photos.iter().map(|p| PhotoTargets { photo: p.id.clone(), targets: Vec::new() }).collect();
    let is_named = |id: &str| id[1..].parse::<usize>().is_ok_and(|k| k < named);
    for o in &project.observations {
        let photo = targets.iter_mut().find(|t| t.photo == o.photo).expect("its photo");
        photo.targets.push(target(o.u, o.v));
        if !is_named(&o.point) {
            truth.insert((o.photo.clone(), o.u.to_bits()), o.point.clone());
        }
    }
    for photo in &mut targets {
        for _ in 0..clutter {
            photo.targets.push(target(1500.0 * (1.0 + uniform(&mut g)), 1000.0 * (1.0 + uniform(&mut g))));
        }
    }
    project.observations.retain(|o| is_named(&o.point));
    project.points.retain(|p| is_named(&p.id));
    Scene { project, targets, truth }
}

/// Points whose rays are all of one true point, points that mix, and true points of three or more rays that got a name.
fn judged(scene: &Scene, matching: &Matching) -> (usize, usize, BTreeSet<String>) {
    let (mut pure, mut mixed, mut found) = (0, 0, BTreeSet::new());
    for point in &matching.points {
        let rays = matching.observations.iter().filter(|o| o.point == point.id);
        let origins: BTreeSet<Option<&String>> =
            rays.map(|o| scene.truth.get(&(o.photo.clone(), o.u.to_bits()))).collect();
        match origins.iter().collect::<Vec<_>>()[..] {
            [Some(origin)] => {
                pure += 1;
                found.insert((*origin).clone());
            }
            _ => mixed += 1,
        }
    }
    (pure, mixed, found)
}

#[test]
fn dots_among_clutter_are_named_and_never_mixed() {
    for seed in 0..4 {
        let scene = scene(seed, 7, 90, 15, 60);
        let matching = match_uncoded(&scene.project, &scene.targets, &MatchOptions::default()).expect("valid");
        let (pure, mixed, found) = judged(&scene, &matching);
        println!("seed {seed}: {pure} pure, {mixed} mixed, {} doubtful", matching.doubtful.len());
        assert_eq!(mixed, 0, "seed {seed}");
        assert_eq!(pure, found.len(), "seed {seed}: a point was named twice");
        let mut rays: BTreeMap<&String, usize> = BTreeMap::new();
        scene.truth.values().for_each(|id| *rays.entry(id).or_default() += 1);
        let wanted: Vec<&String> = rays.iter().filter(|(_, n)| **n >= 4).map(|(id, _)| *id).collect();
        let missed = wanted.iter().filter(|id| !found.contains(**id)).count();
        assert!(missed * 20 <= wanted.len(), "seed {seed}: {missed} of {} missed", wanted.len());
    }
}

#[test]
fn names_avoid_those_there_are_and_known_points_are_found_again() {
    let mut scene = scene(9, 6, 40, 20, 0);
    scene.project.points.push(Point { id: "u1".into(), ..Point::default() });
    // A named point loses its observation in one photo; the target is still there.
    let lost = scene.project.observations.iter().position(|o| o.point == "p3").expect("an observation");
    let lost = scene.project.observations.remove(lost);
    let matching = match_uncoded(&scene.project, &scene.targets, &MatchOptions::default()).expect("valid");
    assert!(matching.points.len() >= 15 && matching.points.iter().all(|p| p.id != "u1" && p.xyz.is_some()));
    let again = matching.observations.iter().find(|o| o.photo == lost.photo && o.point == "p3").expect("found again");
    assert_eq!((again.u, again.v), (lost.u, lost.v));
    let twice = match_uncoded(&scene.project, &scene.targets, &MatchOptions::default()).expect("valid");
    assert_eq!(matching, twice);
}

#[test]
fn chance_is_not_believed_and_nothing_is_no_fault() {
    // Clutter alone: no two photos show the same thing.
    let mut scene = scene(20, 6, 20, 20, 150);
    let named: BTreeSet<u64> = scene.project.observations.iter().map(|o| o.u.to_bits()).collect();
    let matching = match_uncoded(&scene.project, &scene.targets, &MatchOptions::default()).expect("valid");
    let invented = matching.points.len();
    assert!(invented <= 1, "{invented} points out of clutter");
    assert!(matching.observations.iter().all(|o| !named.contains(&o.u.to_bits())));
    // No targets, no orientation: empty results.
    let empty = match_uncoded(&scene.project, &[], &MatchOptions::default()).expect("valid");
    assert_eq!(empty, Matching::default());
    scene.project.photos.iter_mut().for_each(|p| p.position = None);
    let unoriented = match_uncoded(&scene.project, &scene.targets, &MatchOptions::default()).expect("valid");
    assert_eq!(unoriented, Matching::default());
}
