//! Names, points and observations of a board's dots in all photos.

use std::collections::{BTreeMap, BTreeSet};

use super::super::{PhotoTargets, observed};
use super::board::Board;
use super::outcome::{GridNaming, GridOptions, GridOrientation, NamedGrid, Unnamed};
use super::reading::{BoardReading, read};
use crate::detection::Target;
use crate::error::Result;
use crate::project::Project;

/// Distance in pixels within which a measurement is one of a target's centre, at least; and in shares of its minor axis.
const SAME_PX: f64 = 1.0;
const SAME_SHARE: f64 = 0.25;

/// A dot's name: rows and columns count from 1, in the order of the board's coordinates.
fn name(prefix: &str, [row, column]: [u32; 2]) -> String {
    format!("{prefix}r{}c{}", row + 1, column + 1)
}

fn same_place(target: &Target, u: f64, v: f64) -> bool {
    (target.u - u).hypot(target.v - v) < (SAME_SHARE * target.minor).max(SAME_PX)
}

/// Names the dots of a board in photos: `r1c1` is the first dot of the first row. The points are at the board's coordinates, control points
/// with [`Board::sigma`] or tie points without.
///
/// `project` gives the sizes of the photos, which tell where ground without dots is seen, and the names in use. The project is left as it
/// is. Photos are independent of each other except for [`GridOptions::first`].
///
/// # Errors
/// Those of [`Board::check`] and [`Project::validate`].
pub fn name_grid(
    project: &Project,
    photos: &[PhotoTargets],
    board: &Board,
    options: &GridOptions,
) -> Result<GridNaming> {
    board.check()?;
    project.validate()?;
    let sizes: BTreeMap<&str, [u32; 2]> = project
        .photos
        .iter()
        .filter_map(|p| {
            let camera = project.cameras.iter().find(|c| c.id == p.camera)?;
            Some((p.id.as_str(), [camera.width, camera.height]))
        })
        .collect();
    let mut naming = GridNaming::default();
    let mut readings: Vec<(&PhotoTargets, BoardReading)> = Vec::new();
    for photo in photos {
        match read(&photo.targets, sizes.get(photo.photo.as_str()).copied(), board) {
            Ok(reading) => readings.push((photo, reading)),
            Err(reason) => {
                let sentence = reason.to_string();
                naming.unnamed.push(Unnamed { photo: photo.photo.clone(), reason, sentence });
            }
        }
    }
    let chosen = turns(&readings, options);
    naming.prefix = prefix(project, board, &readings, &chosen);
    let points: BTreeSet<&str> = project.points.iter().map(|p| p.id.as_str()).collect();
    let mut new: BTreeSet<[u32; 2]> = BTreeSet::new();
    for ((photo, reading), (way, orientation)) in readings.iter().zip(&chosen) {
        let there: Vec<_> = project.observations.iter().filter(|o| o.photo == photo.photo).collect();
        let dots = &reading.ways[*way];
        let mut named_before = 0;
        for (dot, k) in dots {
            let (target, id) = (&photo.targets[*k], name(&naming.prefix, *dot));
            if there.iter().any(|o| o.point == id) {
                continue;
            }
            if there.iter().any(|o| o.enabled && same_place(target, o.u, o.v)) {
                named_before += 1;
                continue;
            }
            naming.observations.push(observed(&photo.photo, &id, target));
            if !points.contains(id.as_str()) {
                new.insert(*dot);
            }
        }
        naming.named.push(NamedGrid {
            photo: photo.photo.clone(),
            dots: dots.len(),
            missing: board.dots() - dots.len(),
            named_before,
            orientation: *orientation,
            turns: reading.ways.len(),
            by_border: reading.by_border,
        });
    }
    naming.points = new.iter().map(|dot| board.point(name(&naming.prefix, *dot), *dot)).collect();
    Ok(naming)
}

/// The way to name each photo's dots.
fn turns(readings: &[(&PhotoTargets, BoardReading)], options: &GridOptions) -> Vec<(usize, GridOrientation)> {
    let given = |(photo, reading): &(&PhotoTargets, BoardReading)| {
        let at = options.first.get(&photo.photo).filter(|at| at.iter().all(|x| x.is_finite()))?;
        let distance = |way: &usize| reading.first[*way].map_or(f64::INFINITY, |f| (f[0] - at[0]).hypot(f[1] - at[1]));
        (0..reading.ways.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)))
    };
    let turned = |r: &&(&PhotoTargets, BoardReading)| r.1.ways.len() > 1;
    let elsewhere = readings.iter().filter(turned).find_map(given);
    let choice = |r: &(&PhotoTargets, BoardReading)| match (r.1.ways.len(), given(r), elsewhere) {
        (1, ..) if r.1.marked => (0, GridOrientation::Mark),
        (0 | 1, ..) => (0, GridOrientation::Unique),
        (ways, Some(way), _) | (ways, None, Some(way)) => (way % ways, GridOrientation::Given),
        (_, None, None) => (0, GridOrientation::Assumed),
    };
    readings.iter().map(choice).collect()
}

/// What keeps the names apart from those of other points. Points that have the names are of this board if a photo has one of them measured
/// where it is found now, and otherwise if their coordinates are the board's.
fn prefix(
    project: &Project,
    board: &Board,
    readings: &[(&PhotoTargets, BoardReading)],
    chosen: &[(usize, GridOrientation)],
) -> String {
    let points: BTreeMap<&str, Option<[f64; 3]>> = project.points.iter().map(|p| (p.id.as_str(), p.xyz)).collect();
    let measured: BTreeMap<(&str, &str), [f64; 2]> =
        project.observations.iter().map(|o| ((o.photo.as_str(), o.point.as_str()), [o.u, o.v])).collect();
    let apart = |dot: [u32; 2], xyz: [f64; 3]| {
        let own = board.point(String::new(), dot).xyz.unwrap_or_default();
        (0..3).any(|k| (own[k] - xyz[k]).abs() > 0.5 * board.pitch)
    };
    let free = |prefix: &str| {
        let (mut measured_here, mut elsewhere) = (false, false);
        for ((photo, reading), (way, _)) in readings.iter().zip(chosen) {
            for (dot, k) in &reading.ways[*way] {
                let id = name(prefix, *dot);
                match measured.get(&(photo.photo.as_str(), id.as_str())) {
                    Some([u, v]) if same_place(&photo.targets[*k], *u, *v) => measured_here = true,
                    Some(_) => return false,
                    None => elsewhere |= points.get(id.as_str()).copied().flatten().is_some_and(|xyz| apart(*dot, xyz)),
                }
            }
        }
        measured_here || !elsewhere
    };
    let numbered = (2..).map(|n| format!("b{n}-"));
    std::iter::once(String::new()).chain(numbered).find(|p| free(p)).unwrap_or_default()
}
