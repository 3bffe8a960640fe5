//! The long tables: columns of numbers on this side, `tables.js` makes rows of objects of them on the other.

use std::collections::HashMap;

use js_sys::{Array, Float64Array, JsString, Object, Uint32Array};
use wasm_bindgen::prelude::*;

use sightline::adjustment::{AdjustedObservation, AdjustedPoint};
use sightline::detection::{self, Rejected};
use sightline::error::{Error, Expected, Place, Reason, Result, shortened};
use sightline::project::{Observation, Point, Role, Sigma};

#[wasm_bindgen(module = "/src/tables.js")]
extern "C" {
    type Columns;
    #[wasm_bindgen(method, getter)]
    fn row(this: &Columns) -> Option<u32>;
    #[wasm_bindgen(method, getter)]
    fn field(this: &Columns) -> String;
    #[wasm_bindgen(method, getter)]
    fn expected(this: &Columns) -> String;
    #[wasm_bindgen(method, getter)]
    fn message(this: &Columns) -> Option<String>;
    #[wasm_bindgen(method, getter)]
    fn whole(this: &Columns) -> Option<bool>;
    #[wasm_bindgen(method, getter)]
    fn photo(this: &Columns) -> Option<String>;
    #[wasm_bindgen(method, getter)]
    fn point(this: &Columns) -> Option<String>;
    #[wasm_bindgen(method, getter)]
    fn numbers(this: &Columns) -> Float64Array;
    #[wasm_bindgen(method, getter)]
    fn places(this: &Columns) -> Uint32Array;
    #[wasm_bindgen(method, getter)]
    fn names(this: &Columns) -> Vec<String>;

    #[wasm_bindgen(js_name = readObservations)]
    fn read_observations(rows: &JsValue) -> Columns;
    #[wasm_bindgen(js_name = readPoints)]
    fn read_points(rows: &JsValue) -> Columns;
    #[wasm_bindgen(js_name = writeObservations)]
    fn write_observations(numbers: &[f64], places: &[u32], names: &Array) -> Array;
    #[wasm_bindgen(js_name = writePoints)]
    fn write_points(numbers: &[f64], places: &[u32], names: &Array) -> Array;
    #[wasm_bindgen(js_name = addAdjustedObservations)]
    fn add_observations(adjustment: &Object, numbers: &[f64], places: &[u32], names: &Array);
    #[wasm_bindgen(js_name = addRejected)]
    fn add_rejected(detection: &Object, numbers: &[f64], reasons: &[u32], names: &Array);
    #[wasm_bindgen(js_name = writeAdjustedPoints)]
    fn write_adjusted_points(numbers: &[f64], places: &[u32], names: &Array) -> Array;
}

/// Bits of an observation's flags.
const ENABLED: u32 = 1;
const TWO_SIGMAS: u32 = 2;
/// Bits of a point's flags, above its role.
const COORDINATES: u32 = 4;
const SIGMAS: u32 = 8;
const NORMAL: u32 = 16;

/// Observations of a project from its rows.
pub fn observations(rows: &JsValue) -> Result<Vec<Observation>> {
    let columns = checked(read_observations(rows), "observations")?;
    let (numbers, places, names) = (columns.numbers().to_vec(), columns.places().to_vec(), columns.names());
    let row = |(n, p): (&[f64], &[u32])| Observation {
        photo: names[p[0] as usize].clone(),
        point: names[p[1] as usize].clone(),
        u: n[0],
        v: n[1],
        sigma: if p[2] & TWO_SIGMAS == 0 { Sigma::One(n[2]) } else { Sigma::Two([n[2], n[3]]) },
        enabled: p[2] & ENABLED != 0,
        target: Some(p[3]).filter(|number| *number > 0),
    };
    Ok(numbers.chunks_exact(4).zip(places.chunks_exact(4)).map(row).collect())
}

/// Points of a project from their rows.
pub fn points(rows: &JsValue) -> Result<Vec<Point>> {
    let columns = checked(read_points(rows), "points")?;
    let (numbers, flags) = (columns.numbers().to_vec(), columns.places().to_vec());
    let row = |((id, n), flags): ((String, &[f64]), u32)| Point {
        id,
        role: [Role::Tie, Role::Control, Role::Check][(flags & 3) as usize],
        xyz: (flags & COORDINATES != 0).then(|| [n[0], n[1], n[2]]),
        sigma: (flags & SIGMAS != 0)
            .then(|| [n[3], n[4], n[5]].map(|sigma| Some(sigma).filter(|sigma| !sigma.is_nan()))),
        diameter: Some(n[6]).filter(|diameter| !diameter.is_nan()),
        normal: (flags & NORMAL != 0).then(|| [n[7], n[8], n[9]]),
    };
    Ok(columns.names().into_iter().zip(numbers.chunks_exact(10)).zip(flags).map(row).collect())
}

/// Rows of a project's observations.
pub fn observation_rows(observations: &[Observation]) -> Array {
    let mut names = Names::default();
    let (mut last_photo, mut last_point) = (Repeated::default(), Repeated::default());
    let (mut numbers, mut places) =
        (Vec::with_capacity(4 * observations.len()), Vec::with_capacity(4 * observations.len()));
    // Rows are taken apart by name everywhere below, so that the compiler misses a new field before a reader does.
    for Observation { photo, point, u, v, sigma, enabled, target } in observations {
        let [su, sv] = sigma.both();
        numbers.extend([*u, *v, su, sv]);
        let two = if matches!(sigma, Sigma::Two(_)) { TWO_SIGMAS } else { 0 };
        let flags = two | if *enabled { ENABLED } else { 0 };
        let (photo, point) = (last_photo.number(&mut names, photo), last_point.number(&mut names, point));
        places.extend([photo, point, flags, target.unwrap_or(0)]);
    }
    write_observations(&numbers, &places, &names.list)
}

/// Rows of a project's points.
pub fn point_rows(points: &[Point]) -> Array {
    let names: Array = points.iter().map(|point| JsString::from(point.id.as_str())).collect();
    let (mut numbers, mut flags) = (Vec::with_capacity(10 * points.len()), Vec::with_capacity(points.len()));
    for Point { id: _, role, xyz, sigma, diameter, normal } in points {
        numbers.extend(xyz.unwrap_or([f64::NAN; 3]));
        numbers.extend(sigma.unwrap_or_default().map(|sigma| sigma.unwrap_or(f64::NAN)));
        numbers.push(diameter.unwrap_or(f64::NAN));
        numbers.extend(normal.unwrap_or([f64::NAN; 3]));
        let role = match role {
            Role::Tie => 0,
            Role::Control => 1,
            Role::Check => 2,
        };
        let coordinates = if xyz.is_some() { COORDINATES } else { 0 };
        let sigmas = if sigma.is_some() { SIGMAS } else { 0 };
        let normal = if normal.is_some() { NORMAL } else { 0 };
        flags.push(role | coordinates | sigmas | normal);
    }
    write_points(&numbers, &flags, &names)
}

/// Gives an adjustment its field of adjusted observations, whose rows are made when they are read.
pub fn add_adjusted_observations(adjustment: &Object, observations: &[AdjustedObservation]) {
    let mut names = Names::default();
    let (mut last_photo, mut last_point) = (Repeated::default(), Repeated::default());
    let (mut numbers, mut places) =
        (Vec::with_capacity(11 * observations.len()), Vec::with_capacity(3 * observations.len()));
    for AdjustedObservation {
        photo,
        point,
        vx,
        vy,
        rx,
        ry,
        wx,
        wy,
        mdb_x,
        mdb_y,
        effect_x,
        effect_y,
        weight,
        enabled,
    } in observations
    {
        numbers.extend(
            [vx, vy, rx, ry, wx, wy, mdb_x, mdb_y, effect_x, effect_y, weight].map(|number| number.unwrap_or(f64::NAN)),
        );
        places.extend([
            last_photo.number(&mut names, photo),
            last_point.number(&mut names, point),
            u32::from(*enabled),
        ]);
    }
    add_observations(adjustment, &numbers, &places, &names.list);
}

/// Rows of adjusted points.
pub fn adjusted_point_rows(points: &[AdjustedPoint]) -> Array {
    let names: Array = points.iter().map(|point| JsString::from(point.id.as_str())).collect();
    let (mut numbers, mut places) = (Vec::with_capacity(12 * points.len()), Vec::with_capacity(2 * points.len()));
    for AdjustedPoint { id: _, xyz, sigma, covariance, rays } in points {
        numbers.extend(*xyz);
        numbers.extend(sigma.unwrap_or([f64::NAN; 3]));
        numbers.extend(covariance.unwrap_or([f64::NAN; 6]));
        places.extend([*rays as u32, u32::from(sigma.is_some()) + 2 * u32::from(covariance.is_some())]);
    }
    write_adjusted_points(&numbers, &places, &names)
}

/// Gives a detection its field of rejected blobs, whose rows are made when they are read.
pub fn add_rejected_blobs(detection: &Object, blobs: &[Rejected]) {
    let mut names: Vec<detection::Reason> = Vec::new();
    let (mut numbers, mut reasons) = (Vec::with_capacity(3 * blobs.len()), Vec::with_capacity(blobs.len()));
    for Rejected { u, v, diameter, reason } in blobs {
        numbers.extend([*u, *v, *diameter]);
        let at = names.iter().position(|name| name == reason).unwrap_or_else(|| {
            names.push(*reason);
            names.len() - 1
        });
        reasons.push(at as u32);
    }
    let names: Array = names.iter().map(super::value::write).collect();
    add_rejected(detection, &numbers, &reasons, &names);
}

/// Identifiers numbered by their first appearance.
#[derive(Default)]
struct Names<'a> {
    numbers: HashMap<&'a str, u32>,
    list: Array,
}

impl<'a> Names<'a> {
    fn number(&mut self, name: &'a str) -> u32 {
        *self.numbers.entry(name).or_insert_with(|| self.list.push(&JsString::from(name)) - 1)
    }
}

/// The identifier of the row before, with its number: rows of one photo or point often follow each other.
#[derive(Default)]
struct Repeated<'a>(Option<(&'a str, u32)>);

impl<'a> Repeated<'a> {
    fn number(&mut self, names: &mut Names<'a>, name: &'a str) -> u32 {
        match self.0 {
            Some((last, number)) if last == name => number,
            _ => {
                let number = names.number(name);
                self.0 = Some((name, number));
                number
            }
        }
    }
}

/// The columns, or what is wrong in which row, with the photo and point that the row names.
fn checked(columns: Columns, table: &str) -> Result<Columns> {
    let Some(row) = columns.row() else { return Ok(columns) };
    let field = columns.field();
    let path = match field.as_str() {
        _ if columns.whole().unwrap_or(false) => table.to_owned(),
        "" => format!("{table}[{row}]"),
        field => format!("{table}[{row}].{field}"),
    };
    let name = path.clone();
    let reason = match Expected::named(&columns.expected()) {
        Some(expected) => Reason::NotOfKind { name, expected },
        None => Reason::Unreadable { name, message: shortened(&columns.message().unwrap_or_default()) },
    };
    let at = Place { photo: columns.photo(), point: columns.point(), field: Some(path), ..Place::default() };
    Err(Error::Invalid { reason, at })
}
