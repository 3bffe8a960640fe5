//! Boards of circles: lists of targets drawn at random, photos rendered and detected, and OpenCV's photos.

use sightline::decode;
use sightline::detect::detect;
use sightline::detection::{DetectOptions, Target};
use sightline::image::{Grey, GreyView, Samples, SamplesView};
use sightline::matching::{
    Board, BoardKind, GridNaming, GridOptions, GridOrientation, PhotoTargets, UnnamedReason, name_grid,
};
use sightline::project::{Photo, Project, Role};
use sightline_plan::render::{Exposure, render};
use sightline_plan::scene::{Disc, Face, Scene};

use crate::support::boards::{self, Trouble, View, board, document, random_board, random_camera, view};
use crate::support::networks::Uniform;
use crate::support::{data, extent, grid_fit};

const CALM: Trouble =
    Trouble { aside: 0.1, missing: 0.0, occluder: false, clutter: 0.0, second: false, noise_px: 0.05 };
const ROUGH: Trouble =
    Trouble { aside: 0.7, missing: 0.08, occluder: true, clutter: 80.0, second: true, noise_px: 0.1 };

fn dot_of(name: &str) -> [u32; 2] {
    let (row, column) = name.split_once('c').expect("a column");
    let number = |text: &str| text.parse::<u32>().expect("a number") - 1;
    [number(row.trim_start_matches('r')), number(column)]
}

/// Number of wrong names, for the turn of the board that explains most of them.
fn wrong(naming: &GridNaming, board: &Board, truth: &[Option<[u32; 2]>]) -> usize {
    let (rows, columns) = (board.rows, board.columns);
    let turned = |turn: u32, [i, j]: [u32; 2]| match turn {
        0 => [i, j],
        1 => [rows - 1 - i, columns - 1 - j],
        2 => [j, rows - 1 - i],
        _ => [rows - 1 - j, i],
    };
    let turns = naming.named.first().map_or(1, |n| n.turns as u32);
    let count = |turn: u32| {
        let is_wrong =
            |target: u32, name: &str| truth[target as usize - 1].map(|d| turned(turn, d)) != Some(dot_of(name));
        naming.observations.iter().filter(|o| is_wrong(o.target.expect("a target"), &o.point)).count()
    };
    (0..turns).map(count).min().unwrap_or(0)
}

fn named(view: &View) -> GridNaming {
    let (project, targets) = document(view);
    name_grid(&project, &targets, &view.board, &GridOptions::default()).expect("a board")
}

/// Views named, of how many; whole ones apart. None may be wrong.
fn run(count: usize, make: impl Fn(u64) -> View) -> [(usize, usize); 2] {
    let mut tally = [(0, 0); 2];
    for seed in 0..count as u64 {
        let view = make(seed);
        let naming = named(&view);
        assert_eq!(wrong(&naming, &view.board, &view.truth), 0, "seed {seed}: {:?} {:?}", view.board, naming.named);
        let (named, all) = &mut tally[usize::from(!view.whole)];
        *all += 1;
        *named += naming.named.len();
        // what is not named has its reason, and what is named is nearly all that is seen
        assert_eq!(naming.named.len() + naming.unnamed.len(), 1);
        let seen = view.truth.iter().flatten().count();
        if view.whole && !naming.named.is_empty() {
            assert!(
                naming.observations.len() as f64 >= 0.95 * seen as f64,
                "seed {seed}: {} of {seen}",
                naming.observations.len()
            );
        }
    }
    tally
}

fn lens(seed: u64) -> sightline::project::Camera {
    random_camera(&mut Uniform(seed * 77 + 5))
}

#[test]
fn a_hundred_views_of_a_board_are_named_and_none_wrongly() {
    for (board, diameter) in [
        (board(13, 7, BoardKind::Asymmetric), 14.0),
        (board(7, 9, BoardKind::Symmetric), 10.0),
        (board(7, 7, BoardKind::Symmetric), 10.0),
    ] {
        let [whole, part] = run(100, |seed| view(&board, diameter, lens(seed), CALM, seed));
        assert_eq!((whole.0, part.0), (whole.1, part.1), "{board:?}");
        let aside = Trouble { aside: 0.6, missing: 0.03, clutter: 20.0, ..CALM };
        let [whole, part] = run(extent::cases(100, 1000), |seed| view(&board, diameter, lens(seed), aside, seed));
        assert!(whole.0 as f64 >= 0.97 * whole.1 as f64, "{board:?}: {whole:?}, partial {part:?}");
    }
}

#[test]
fn no_board_of_any_size_is_named_wrongly_whatever_stands_in_the_way() {
    let [_, part] = run(extent::cases(300, 5000), |seed| {
        let (mut board, diameter) = random_board(&mut Uniform(seed * 31 + 3));
        board.diameter = Some(diameter);
        view(&board, diameter, lens(seed), ROUGH, seed)
    });
    assert!(part.0 * 10 >= part.1, "{part:?}");
}

#[test]
fn a_window_of_the_board_is_ambiguous_and_a_cut_board_is_not() {
    let asymmetric = board(13, 7, BoardKind::Asymmetric);
    let whole = view(&asymmetric, 14.0, lens(4), CALM, 11);
    let keep = |rows: std::ops::Range<u32>, view: &View| {
        let rest = |(t, dot): (&Target, &Option<[u32; 2]>)| {
            dot.is_some_and(|[i, _]| rows.contains(&i)).then(|| (t.clone(), *dot))
        };
        let (targets, truth) = view.targets.iter().zip(&view.truth).filter_map(rest).unzip();
        View { targets, truth, camera: view.camera.clone(), board: view.board.clone(), ..*view }
    };
    // rows 3 to 8 with ground of hidden rows on both sides
    let window = keep(3..9, &whole);
    assert!(matches!(named(&window).unnamed[0].reason, UnnamedReason::Ambiguous { .. }));
    // the last row hidden: the board may lie with its first row there
    assert!(named(&keep(0..12, &whole)).named.is_empty());
}

#[test]
fn a_symmetric_board_is_asked_about_once_and_a_mark_answers_it() {
    let mut symmetric = board(7, 9, BoardKind::Symmetric);
    let seen = view(&symmetric, 10.0, lens(4), CALM, 21);
    let (project, targets) = document(&seen);
    let free = name_grid(&project, &targets, &symmetric, &GridOptions::default()).expect("a board");
    assert_eq!((free.named[0].orientation, free.named[0].turns), (GridOrientation::Assumed, 2));
    let place = |dot: [u32; 2]| {
        let k = seen.truth.iter().position(|d| *d == Some(dot)).expect("seen");
        [seen.targets[k].u, seen.targets[k].v]
    };
    for first in [[0, 0], [6, 8]] {
        let options = GridOptions { first: [("a".to_owned(), place(first))].into() };
        let asked = name_grid(&project, &targets, &symmetric, &options).expect("a board");
        assert_eq!(asked.named[0].orientation, GridOrientation::Given);
        let o = asked.observations.iter().find(|o| o.point == "r1c1").expect("the first dot");
        assert!((o.u - place(first)[0]).hypot(o.v - place(first)[1]) < 1e-9);
    }
    // a target beside the last corner
    let mut marked = targets.clone();
    let corner = [[6, 8], [6, 7], [5, 8]].map(place);
    let beside = |k: usize| 2.0 * corner[0][k] - 0.5 * (corner[1][k] + corner[2][k]);
    let mark = Target { id: 999, u: beside(0), v: beside(1), ..seen.targets[0].clone() };
    symmetric.mark = Some([-0.5 * symmetric.pitch, -0.5 * symmetric.pitch]);
    assert!(matches!(
        name_grid(&project, &targets, &symmetric, &GridOptions::default()).expect("a board").unnamed[0].reason,
        UnnamedReason::Mark { seen: 0 }
    ));
    marked[0].targets.push(mark);
    let naming = name_grid(&project, &marked, &symmetric, &GridOptions::default()).expect("a board");
    assert_eq!(naming.named[0].orientation, GridOrientation::Mark);
    let o = naming.observations.iter().find(|o| o.point == "r1c1").expect("the first dot");
    assert!((o.u - place([6, 8])[0]).hypot(o.v - place([6, 8])[1]) < 1e-9);
}

#[test]
fn names_are_kept_apart_from_others_and_given_once() {
    let asymmetric = board(13, 7, BoardKind::Asymmetric);
    let seen = view(&asymmetric, 14.0, lens(4), CALM, 11);
    let (mut project, targets) = document(&seen);
    let first = named(&seen);
    assert_eq!((first.prefix.as_str(), first.points.len(), first.points[0].role), ("", 91, Role::Control));
    assert_eq!(first.points[8].xyz, Some([3.0 * 20.0, 20.0, 0.0]));
    project.points.clone_from(&first.points.into());
    project.observations.clone_from(&first.observations.into());
    let again = name_grid(&project, &targets, &asymmetric, &GridOptions::default()).expect("a board");
    assert!(again.prefix.is_empty() && again.points.is_empty() && again.observations.is_empty());
    // a board of another pitch in the same photo's place
    project.observations.clear();
    let other = Board { pitch: 30.0, sigma: None, ..asymmetric };
    let second = name_grid(&project, &targets, &other, &GridOptions::default()).expect("a board");
    assert_eq!(
        (second.prefix.as_str(), second.points[0].id.as_str(), second.points[0].role),
        ("b2-", "b2-r1c1", Role::Tie)
    );
}

/// The view as a picture, with the targets found in it and their truth.
fn rendered(view: &View, diameter: f64, seed: u64) -> View {
    let (dark, white) = (0.12, 0.8);
    let last = boards::place(&view.board, [view.board.rows - 1, view.board.columns - 1]);
    let margin = 3.0 * view.board.pitch;
    let paper = Face {
        corner: [-margin, -margin, 0.0],
        along: [last.x + view.board.pitch + 2.0 * margin, 0.0, 0.0],
        across: [0.0, last.y + 2.0 * margin, 0.0],
        grey: white,
        texture: 0.0,
        grain: 1.0,
    };
    let disc = |dot: [u32; 2]| Disc {
        id: format!("r{}c{}", dot[0] + 1, dot[1] + 1),
        centre: boards::place(&view.board, dot).into(),
        normal: [0.0, 0.0, -1.0],
        diameter,
        ring: None,
        grey: dark,
        patch: None,
    };
    let scene = Scene { faces: vec![paper], discs: boards::dots(&view.board).map(disc).collect(), background: 0.3 };
    let exposure = Exposure { seed, ..Exposure::default() };
    let picture = render(&view.camera, &view.pose, &scene, &exposure, 0).expect("a picture");
    let targets = detected(&picture);
    let near = |t: &Target| {
        let k = view.targets.iter().position(|other| (other.u - t.u).hypot(other.v - t.v) < 0.4 * other.minor)?;
        view.truth[k]
    };
    let truth = targets.iter().map(near).collect();
    View { targets, truth, camera: view.camera.clone(), board: view.board.clone(), ..*view }
}

fn detected(picture: &Grey) -> Vec<Target> {
    let samples = match &picture.samples {
        Samples::U8(samples) => SamplesView::U8(samples),
        Samples::U16(samples) => SamplesView::U16(samples),
    };
    let view = GreyView::new(picture.width, picture.height, samples).expect("a picture");
    detect(&view, &DetectOptions::default()).expect("valid options").targets
}

#[test]
fn rendered_views_are_named_from_their_targets() {
    let board = board(13, 7, BoardKind::Asymmetric);
    let diameter = 14.0;
    let (mut all, mut found) = (0, 0);
    for seed in 0..extent::cases(10, 100) as u64 {
        let seen = rendered(&view(&board, diameter, lens(seed), Trouble { aside: 0.4, ..CALM }, seed), diameter, seed);
        let naming = named(&seen);
        // a dot cut by the border is not in the list of the drawn ones; its neighbours are named all the same
        let known = GridNaming {
            observations: naming
                .observations
                .iter()
                .filter(|o| seen.truth[o.target.map_or(0, |t| t as usize - 1)].is_some())
                .cloned()
                .collect(),
            ..naming.clone()
        };
        assert_eq!(wrong(&known, &board, &seen.truth), 0, "seed {seed}");
        all += 1;
        found += naming.named.len();
        if naming.named.is_empty() {
            println!("seed {seed}: {} targets, {}", seen.targets.len(), naming.unnamed[0].sentence);
        }
    }
    assert!(found * 10 >= all * 9, "{found} of {all}");
}

#[test]
fn the_boards_of_opencvs_photos_are_named_as_opencv_names_them() {
    let Some(grids) = data::text("photos/grids.json") else { return };
    for (name, [columns, rows], centres) in grid_fit::grids(&grids) {
        let Some(bytes) = data::data(&format!("photos/{name}")) else { return };
        let picture = decode::grey(&bytes, DetectOptions::default().channel).expect("a picture");
        let mut targets = detected(&picture);
        (1..).zip(&mut targets).for_each(|(id, t): (u32, _)| t.id = id);
        let kind = if name.starts_with('a') { BoardKind::Asymmetric } else { BoardKind::Symmetric };
        let board = board(rows as u32, columns as u32, kind);
        let truth: Vec<_> = targets
            .iter()
            .map(|t| {
                let k = centres.iter().position(|[u, v]| (u - t.u).hypot(v - t.v) < 3.0)?;
                Some([(k / columns) as u32, (k % columns) as u32])
            })
            .collect();
        // of five rows only two dots and two empty sites at the ends of the shifted rows tell the turn: the photo's size is needed
        let mut camera = lens(1);
        (camera.width, camera.height) = (picture.width as u32, picture.height as u32);
        let photo = Photo { id: name.clone(), camera: "cam".into(), enabled: true, ..Photo::default() };
        let project = Project { cameras: vec![camera], photos: vec![photo].into(), ..Project::default() };
        let photos = [PhotoTargets { photo: name.clone(), targets: targets.clone() }];
        let naming = name_grid(&project, &photos, &board, &GridOptions::default()).expect("a board");
        let why = naming.unnamed.first().map(|u| u.sentence.clone());
        assert!(why.is_none(), "{name}: {why:?}");
        assert_eq!(wrong(&naming, &board, &truth), 0, "{name}");
        assert!(
            naming.observations.len() as f64 >= 0.97 * centres.len() as f64,
            "{name}: {}",
            naming.observations.len()
        );
    }
}
