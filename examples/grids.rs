//! Boards of circles rendered at random with their truth, and dots named in pictures, for `tests/peers/grids.py`:
//!
//! ```text
//! grids views FOLDER COUNT ASIDE      COUNT views of a board of 7 x 13 as FOLDER/NUMBER.pgm
//! grids photo FILE ROWS COLUMNS KIND  dots named in a photo; KIND is symmetric or asymmetric
//! ```
//!
//! Answers are JSON: per picture `dots`, [row, column] of the board; `truth`, the pixel of every dot in the picture; `named`, the pixels of
//! the dots that were named. Rows and columns begin with 0; a dot outside the picture or not named is null.

use std::error::Error;
use std::path::Path;

use sightline::camera::pixel_from_camera_point;
use sightline::decode;
use sightline::detect::detect;
use sightline::detection::DetectOptions;
use sightline::image::{Grey, GreyView, Samples, SamplesView};
use sightline::matching::{Board, BoardKind, GridNaming, GridOptions, PhotoTargets, name_grid};
use sightline::project::{Camera, Photo, Project};
use sightline_plan::render::{Exposure, render};
use sightline_plan::scene::{Disc, Face, Scene};

use support::boards::{Trouble, board, dots, place, random_camera, view};
use support::networks::Uniform;

#[path = "."]
mod support {
    #[allow(dead_code, reason = "the tests use the rest")]
    #[path = "../tests/engine/support/boards.rs"]
    pub mod boards;
    #[allow(dead_code, reason = "the tests use the rest")]
    #[path = "../tests/engine/support/networks.rs"]
    pub mod networks;
}

type Outcome<T = ()> = Result<T, Box<dyn Error>>;

/// Diameter of a dot, in the unit of the board's pitch of 20.
const DIAMETER: f64 = 14.0;

fn main() -> Outcome {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let answer = match words[..] {
        ["views", folder, count, aside] => views(Path::new(folder), count.parse()?, aside.parse()?)?,
        ["photo", file, rows, columns, kind] => {
            let kind = match kind {
                "symmetric" => BoardKind::Symmetric,
                "asymmetric" => BoardKind::Asymmetric,
                _ => return Err("a board is symmetric or asymmetric".into()),
            };
            let picture = decode::grey(&std::fs::read(file)?, DetectOptions::default().channel)?;
            let board = board(rows.parse()?, columns.parse()?, kind);
            let mut camera = random_camera(&mut Uniform(5));
            (camera.width, camera.height) = (picture.width.try_into()?, picture.height.try_into()?);
            let naming = named(&picture, camera, &board)?;
            serde_json::json!({ "dots": dots(&board).collect::<Vec<_>>(), "named": pixels(&naming, &board), "why": naming.unnamed.first().map(|u| &u.sentence) })
        }
        _ => return Err("see the head of examples/grids.rs".into()),
    };
    println!("{answer}");
    Ok(())
}

/// Random views of a board of 7 x 13 with a tilt of up to 60 degrees and dots from 8 px; `aside` is the share of the board by which they aim
/// beside its centre at most.
fn views(folder: &Path, count: u64, aside: f64) -> Outcome<serde_json::Value> {
    let board = board(13, 7, BoardKind::Asymmetric);
    let trouble = Trouble { aside, ..Trouble::default() };
    let last = place(&board, [board.rows - 1, board.columns - 1]);
    let margin = 3.0 * board.pitch;
    let paper = Face {
        corner: [-margin, -margin, 0.0],
        along: [last.x + board.pitch + 2.0 * margin, 0.0, 0.0],
        across: [0.0, last.y + 2.0 * margin, 0.0],
        grey: 0.8,
        texture: 0.0,
        grain: 1.0,
    };
    let disc = |dot: [u32; 2]| Disc {
        id: format!("r{}c{}", dot[0] + 1, dot[1] + 1),
        centre: place(&board, dot).into(),
        normal: [0.0, 0.0, -1.0],
        diameter: DIAMETER,
        ring: None,
        grey: 0.12,
        patch: None,
    };
    let scene = Scene { faces: vec![paper], discs: dots(&board).map(disc).collect(), background: 0.3 };
    let mut all = Vec::new();
    for seed in 0..count {
        let seen = view(&board, DIAMETER, random_camera(&mut Uniform(seed * 77 + 5)), trouble, seed);
        let exposure = Exposure { seed, ..Exposure::default() };
        let picture = render(&seen.camera, &seen.pose, &scene, &exposure, 0)?;
        std::fs::write(folder.join(format!("{seed}.pgm")), portable(&picture))?;
        let naming = named(&picture, seen.camera.clone(), &board)?;
        // only dots that are whole in the picture have a truth
        let is_seen = |dot: &[u32; 2]| seen.truth.contains(&Some(*dot));
        let truth = |dot: [u32; 2]| {
            let pixel = pixel_from_camera_point(&seen.camera, seen.pose.to_camera(&place(&board, dot)));
            pixel.filter(|_| is_seen(&dot))
        };
        all.push(serde_json::json!({
            "file": format!("{seed}.pgm"),
            "whole": seen.whole,
            "dots": dots(&board).collect::<Vec<_>>(),
            "truth": dots(&board).map(truth).collect::<Vec<_>>(),
            "named": pixels(&naming, &board),
        }));
    }
    Ok(all.into())
}

/// The targets of a picture named as a board's dots.
fn named(picture: &Grey, camera: Camera, board: &Board) -> Outcome<GridNaming> {
    let samples = match &picture.samples {
        Samples::U8(samples) => SamplesView::U8(samples),
        Samples::U16(samples) => SamplesView::U16(samples),
    };
    let view = GreyView::new(picture.width, picture.height, samples)?;
    let mut targets = detect(&view, &DetectOptions::default())?.targets;
    (1..).zip(&mut targets).for_each(|(id, t): (u32, _)| t.id = id);
    let photo = Photo { id: "a".into(), camera: camera.id.clone(), enabled: true, ..Photo::default() };
    let project = Project { cameras: vec![camera], photos: vec![photo].into(), ..Project::default() };
    let targets = [PhotoTargets { photo: "a".into(), targets }];
    Ok(name_grid(&project, &targets, board, &GridOptions::default())?)
}

/// Pixels of a board's dots, as far as they were named.
fn pixels(naming: &GridNaming, board: &Board) -> Vec<Option<[f64; 2]>> {
    let name = |[row, column]: [u32; 2]| format!("r{}c{}", row + 1, column + 1);
    let of = |dot| naming.observations.iter().find(|o| o.point == name(dot)).map(|o| [o.u, o.v]);
    dots(board).map(of).collect()
}

/// A picture as a PGM of 8 bits.
fn portable(picture: &Grey) -> Vec<u8> {
    let mut file = format!("P5 {} {} 255\n", picture.width, picture.height).into_bytes();
    match &picture.samples {
        Samples::U8(samples) => file.extend(samples),
        Samples::U16(samples) => file.extend(samples.iter().map(|s| (s >> 8) as u8)),
    }
    file
}
