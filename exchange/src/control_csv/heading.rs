//! The heading of a control table: names, axes and units of its columns.

use super::columns::{Columns, Fault, Field};
use super::conventions::{Axes, Basis};
use crate::reason::ExchangeReason;
use sightline::error::{Reason, shortened};
use sightline::units::Unit;

/// Meaning of a column according to its heading.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Said {
    Field(Field),
    /// A horizontal coordinate by its direction: 0 for east, 1 for north.
    Towards(usize),
    /// Its standard error.
    SigmaTowards(usize),
    /// Longitude (0) or latitude (1).
    Geographic(usize),
}

fn plain(text: &str) -> String {
    text.chars().filter(|c| c.is_alphanumeric()).flat_map(char::to_lowercase).collect()
}

/// A word of a heading, whatever its case and punctuation.
fn said(word: &str) -> Option<Said> {
    use Said::{Field as F, Geographic, SigmaTowards, Towards};
    Some(match plain(word).as_str() {
        "id" | "point" | "pointid" | "pt" | "no" | "nr" | "number" | "pointno" | "pointnumber" | "punkt"
        | "punktnummer" | "pktnr" | "matricule" | "numéro" | "点番" | "点番号" | "番号" | "点号" | "점" | "점번호"
        | "번호" | "측점번호" => F(Field::Id),
        "label" | "name" | "description" | "desc" | "descriptor" | "code" | "remark" | "remarks" | "pointname"
        | "이름" | "점명" | "점이름" | "측점" | "측점명" | "기준점" | "기준점명" | "비고" | "설명" | "코드"
        | "bezeichnung" | "bemerkung" | "nom" | "désignation" | "remarque" | "点名" | "名称" | "備考" | "编码"
        | "代码" => F(Field::Label),
        "x" | "xcoord" | "xcoordinate" | "x좌표" | "x座標" => F(Field::X),
        "y" | "ycoord" | "ycoordinate" | "y좌표" | "y座標" => F(Field::Y),
        "e" | "east" | "easting" | "rechts" | "rechtswert" | "ostwert" | "est" | "ost" | "横" | "東" | "东" | "횡"
        | "횡좌표" | "동" | "동쪽" | "e좌표" => Towards(0),
        "n" | "north" | "northing" | "hoch" | "hochwert" | "nordwert" | "nord" | "縦" | "北" | "종" | "종좌표"
        | "북" | "북쪽" | "n좌표" => Towards(1),
        "z"
        | "h"
        | "height"
        | "elevation"
        | "elev"
        | "altitude"
        | "alt"
        | "zcoord"
        | "zcoordinate"
        | "höhe"
        | "hoehe"
        | "hauteur"
        | "高程"
        | "標高"
        | "高さ"
        | "z座標"
        | "z좌표"
        | "h좌표"
        | "표고"
        | "높이"
        | "고도"
        | "지반고"
        | "타원체고"
        | "ellipsoidalheight"
        | "ellipsoidheight"
        | "ellipsoidischehöhe"
        | "楕円体高"
        | "大地高" => F(Field::Z),
        "lon"
        | "long"
        | "lng"
        | "longitude"
        | "경도"
        | "länge"
        | "laenge"
        | "geogrlänge"
        | "geogrlaenge"
        | "geographischelänge"
        | "経度"
        | "经度"
        | "λ" => Geographic(0),
        "lat" | "latitude" | "위도" | "breite" | "geogrbreite" | "geographischebreite" | "緯度" | "纬度" | "φ" => {
            Geographic(1)
        }
        "sx" | "sigmax" | "σx" | "stdx" | "mx" | "sdx" | "xaccuracy" | "accuracyx" | "xacc" => F(Field::Sx),
        "sy" | "sigmay" | "σy" | "stdy" | "my" | "sdy" | "yaccuracy" | "accuracyy" | "yacc" => F(Field::Sy),
        "sxy" | "σxy" | "sigmaxy" | "horizontalaccuracy" | "accuracyhorizontal" | "xyaccuracy" | "accuracyxy"
        | "hacc" | "수평정확도" => F(Field::Sxy),
        "se" | "sigmae" | "σe" | "stde" | "me" | "sde" | "slon" | "sigmalon" | "σlon" | "stdlon" | "sdlon"
        | "longitudeaccuracy" | "accuracylongitude" | "accuracylon" => SigmaTowards(0),
        "sn" | "sigman" | "σn" | "stdn" | "mn" | "sdn" | "slat" | "sigmalat" | "σlat" | "stdlat" | "sdlat"
        | "latitudeaccuracy" | "accuracylatitude" | "accuracylat" => SigmaTowards(1),
        "sz" | "sigmaz" | "σz" | "stdz" | "mz" | "sdz" | "sh" | "sigmah" | "σh" | "zaccuracy" | "accuracyz"
        | "zacc" | "verticalaccuracy" | "accuracyvertical" | "vacc" | "수직정확도" => F(Field::Sz),
        "s" | "sigma" | "σ" | "std" | "sd" | "sxyz" | "sigmaxyz" | "accuracy" | "정확도" => F(Field::Sigma),
        "role" | "type" => F(Field::Role),
        "diameter" | "dia" | "durchmesser" | "diametre" | "diamètre" | "지름" | "직경" | "直径" => {
            F(Field::Diameter)
        }
        _ => return None,
    })
}

/// A heading in parts: its name, and the text in brackets.
struct Heading<'a> {
    name: &'a str,
    square: Vec<&'a str>,
    round: Vec<&'a str>,
}

impl<'a> Heading<'a> {
    fn of(text: &'a str) -> Self {
        let end = text.find(['[', '(']).unwrap_or(text.len());
        let mut found = Self { name: text[..end].trim(), square: Vec::new(), round: Vec::new() };
        let mut rest = &text[end..];
        while let Some(at) = rest.find(['[', '(']) {
            let square = rest[at..].starts_with('[');
            let inner = &rest[at + 1..];
            let close = inner.find(if square { ']' } else { ')' }).unwrap_or(inner.len());
            if square { &mut found.square } else { &mut found.round }.push(inner[..close].trim());
            rest = inner.get(close + 1..).unwrap_or_default();
        }
        found
    }
}

/// A column by its heading.
#[derive(Clone, Debug, Default)]
struct Named {
    said: Option<Said>,
    unit: Option<Unit>,
    /// Text in square brackets that is not a unit.
    unknown_unit: Option<String>,
    /// Unknown text in round brackets.
    remark: bool,
}

impl Named {
    fn of(text: &str) -> Self {
        let heading = Heading::of(text);
        let mut named = Self::default();
        // "X/Easting": the direction decides, the letter does not contradict it.
        let parts: Vec<Option<Said>> = heading.name.split('/').map(said).collect();
        let direction = |all: &[Option<Said>]| {
            all.iter().flatten().copied().find(|said| matches!(said, Said::Towards(_) | Said::SigmaTowards(_)))
        };
        let degrees = parts.iter().flatten().copied().find(|said| matches!(said, Said::Geographic(_)));
        // Of two parts at least one is known, and the others mean no other thing.
        let height = parts.contains(&Some(Said::Field(Field::Z)));
        let sigma = match parts[0] {
            // "Accuracy_X/Y/Z" is one of all axes, "Accuracy_X/Y" one of two.
            Some(Said::Field(Field::Sx)) if parts.len() == 3 && height => Some(Said::Field(Field::Sigma)),
            Some(Said::Field(Field::Sx)) if parts.last() == Some(&Some(Said::Field(Field::Y))) => {
                Some(Said::Field(Field::Sxy))
            }
            Some(Said::Field(field)) if field.is_sigma() => parts[0],
            _ => None,
        };
        named.said = if sigma.is_some() {
            sigma
        } else if degrees.is_some() {
            // "X/Longitude"
            degrees
        } else if parts.len() > 1 && height {
            Some(Said::Field(Field::Z))
        } else {
            direction(&parts).or(parts[0])
        };
        if named.said.is_none() {
            // "X_mm", "Easting m": a unit behind a name that is known without it.
            if let Some((name, unit)) = heading.name.rsplit_once(['_', ' ']) {
                named.unit = Unit::named(unit);
                named.said = match (named.unit, said(name)) {
                    (None, Some(Said::Geographic(k))) if is_degrees(unit) => Some(Said::Geographic(k)),
                    (None, _) | (_, Some(Said::Geographic(_))) => None,
                    (Some(_), said) => said,
                };
            }
        }
        let angle = matches!(named.said, Some(Said::Geographic(_)));
        for text in heading.square {
            match Unit::named(text) {
                None if angle && is_degrees(text) => {}
                Some(unit) if !angle => named.unit = Some(unit),
                _ => named.unknown_unit = Some(shortened(text)),
            }
        }
        for text in heading.round {
            if angle {
                // Degrees are understood; another unit is none of angles of this list; anything else is a remark, such as "WGS84".
                match plain(text).as_str() {
                    _ if is_degrees(text) => {}
                    "gon" | "grad" | "gra" | "rad" | "radian" | "radians" | "mrad" => {
                        named.unknown_unit = Some(shortened(text));
                    }
                    _ if Unit::named(text).is_some() => named.unknown_unit = Some(shortened(text)),
                    _ => named.remark = true,
                }
                continue;
            }
            let horizontal = matches!(named.said, Some(Said::Field(Field::X | Field::Y) | Said::Towards(_)));
            match (Unit::named(text), said(text)) {
                (Some(unit), _) => named.unit = Some(unit),
                (None, Some(said @ (Said::Towards(_) | Said::Geographic(_)))) if horizontal => named.said = Some(said),
                // "N(X)": Korean and German lists name the northing X.
                (None, Some(Said::Field(Field::X | Field::Y))) if horizontal => {}
                (None, Some(Said::Field(Field::Z))) if named.said == Some(Said::Field(Field::Z)) => {}
                _ => named.remark = true,
            }
        }
        named
    }
}

/// Whether a unit of a heading means degrees, in decimals or in minutes and seconds.
fn is_degrees(text: &str) -> bool {
    let bare = plain(text);
    let words = ["deg", "degree", "degrees", "decimaldegrees", "dd", "dms", "dmm", "도", "度"];
    words.contains(&bare.as_str()) || bare.is_empty() && text.contains(['°', '˚', 'º'])
}

/// Units of the columns, as a heading names them.
pub(super) fn units(row: &[String]) -> Vec<Option<Unit>> {
    row.iter().map(|text| Named::of(text).unit).collect()
}

/// Whether a heading names a direction, east or north, and whether it does so without the letters X and Y. "Y, X" names none: whose Y points
/// north is a custom of countries.
pub(super) fn directions(row: &[String]) -> [bool; 2] {
    let lettered = |text: &String| plain(Heading::of(text).name).starts_with(['x', 'y']);
    let named: Vec<&String> =
        row.iter().filter(|text| matches!(Named::of(text).said, Some(Said::Towards(_)))).collect();
    [!named.is_empty(), !named.is_empty() && !named.iter().any(|text| lettered(text))]
}

/// The columns that a heading names: none where the row is no heading.
///
/// # Errors
/// [`Fault`] for a heading that lacks a coordinate, names one twice or has an unknown unit.
pub(super) fn heading(row: &[String]) -> Option<Result<Columns, Fault>> {
    let all: Vec<Named> = row.iter().map(|text| Named::of(text)).collect();
    let axis = |said: Said| match said {
        Said::Towards(_) | Said::SigmaTowards(_) | Said::Geographic(_) => true,
        Said::Field(field) => field.is_number(),
    };
    // A row with a number in it is no heading, and one coordinate by name may be a point called "X".
    let numbers = row.iter().any(|text| text.replacen(',', ".", 1).parse::<f64>().is_ok());
    let named = all.iter().filter(|named| named.said.is_some_and(axis)).count();
    (!numbers && named >= 2).then(|| from_heading(row, &all))
}

fn from_heading(row: &[String], all: &[Named]) -> Result<Columns, Fault> {
    let fault = |field: Field, reason| Err(field.fault(reason));
    let mut fields: Vec<Option<Field>> = all
        .iter()
        .map(|named| match named.said? {
            Said::Field(field) => Some(field),
            Said::Towards(k) => Some([Field::X, Field::Y][k]),
            Said::SigmaTowards(k) => Some([Field::Sx, Field::Sy][k]),
            Said::Geographic(_) => None,
        })
        .collect();
    // Beside coordinates of a plane latitude and longitude are left alone.
    let plane = [Field::X, Field::Y].iter().all(|field| fields.contains(&Some(*field)));
    let geographic = !plane && all.iter().any(|named| matches!(named.said, Some(Said::Geographic(_))));
    if geographic {
        for (field, named) in fields.iter_mut().zip(all) {
            if let Some(Said::Geographic(k)) = named.said {
                *field = Some([Field::Longitude, Field::Latitude][k]);
            }
        }
    }
    let towards = |k: usize| all.iter().position(|named| named.said == Some(Said::Towards(k)));
    let letter = |field: Field| all.iter().position(|named| named.said == Some(Said::Field(field)));
    let mut by = if towards(0).is_some() || towards(1).is_some() { Basis::Heading } else { Basis::Convention };
    // "X (N)" beside "Y": the other one is the easting.
    if let (Some(_), None) | (None, Some(_)) = (towards(0), towards(1)) {
        let known = usize::from(towards(1).is_some());
        let others: Vec<usize> = [Field::X, Field::Y].into_iter().filter_map(letter).collect();
        if let [other] = others[..] {
            fields[other] = Some([Field::X, Field::Y][1 - known]);
        }
    }
    // Standard errors belong to the letters of the coordinates: with X to the north sX is of Y.
    let exchanged = all.iter().enumerate().any(|(k, named)| {
        let name = plain(Heading::of(&row[k]).name);
        matches!(named.said, Some(Said::Towards(1) | Said::Geographic(1))) && name.starts_with('x')
            || matches!(named.said, Some(Said::Towards(0) | Said::Geographic(0))) && name.starts_with('y')
    });
    if exchanged {
        for (field, named) in fields.iter_mut().zip(all) {
            *field = match (named.said, *field) {
                (Some(Said::Field(Field::Sx)), _) => Some(Field::Sy),
                (Some(Said::Field(Field::Sy)), _) => Some(Field::Sx),
                (_, field) => field,
            };
        }
    }
    for (k, field) in fields.iter().enumerate() {
        let Some(field) = field.filter(|field| *field != Field::Label) else { continue };
        if fields[..k].contains(&Some(field)) {
            return fault(field, ExchangeReason::HeadingTwice { name: field.name().into() }.into());
        }
    }
    let [east, north] = if geographic { [Field::Longitude, Field::Latitude] } else { [Field::X, Field::Y] };
    for field in [east, north, Field::Z] {
        if !fields.contains(&Some(field)) {
            let name = field.name().into();
            let reason = match geographic {
                true => ExchangeReason::GeographicIncomplete { name },
                false => ExchangeReason::HeadingIncomplete { name },
            };
            return fault(field, reason.into());
        }
    }
    // Without a column of identifiers the column of names serves as one; without that, the first column does if its heading is unknown.
    if !fields.contains(&Some(Field::Id)) {
        match fields.iter().position(|column| *column == Some(Field::Label)) {
            Some(place) => fields[place] = Some(Field::Id),
            None if fields[0].is_none() => fields[0] = Some(Field::Id),
            None => {
                return fault(Field::Id, ExchangeReason::HeadingIncomplete { name: Field::Id.name().into() }.into());
            }
        }
    }
    for (named, field) in all.iter().zip(&fields) {
        if let (Some(text), Some(field)) = (&named.unknown_unit, field.filter(|field| field.is_number())) {
            let name = "unit".to_owned();
            let choices = if field.is_angle() { "deg, °, dms".to_owned() } else { Unit::list() };
            return fault(field, Reason::NoneOf { name, choices, text: text.clone() });
        }
    }
    let place = |field: Field| fields.iter().position(|column| *column == Some(field));
    let order = if place(east) < place(north) { Axes::Xy } else { Axes::Yx };
    if by == Basis::Convention && letter(Field::X).is_some() {
        by = Basis::Heading;
    }
    let texts = |wanted: &dyn Fn(usize) -> bool| {
        (0..row.len()).filter(|k| wanted(*k) && !row[*k].is_empty()).map(|k| shortened(&row[k])).collect()
    };
    let ignored = texts(&|k| fields[k].is_none());
    let remarks = texts(&|k| all[k].remark && fields[k].is_some_and(Field::is_number));
    let units = all.iter().map(|named| named.unit).collect();
    Ok(Columns { fields, by: Basis::Heading, units, order: (order, by), ignored, remarks })
}
