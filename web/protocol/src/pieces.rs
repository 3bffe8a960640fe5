//! Long objects as text in pieces, each written and read by itself, so that the page does something else between two of them.

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use sightline::adjustment::Adjustment;
use sightline::project::Project;

use crate::{from_bytes, to_bytes};

/// Elements of a piece: some 100 kB.
const ROWS_AT_ONCE: usize = 1000;

/// A piece of an object's text.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Piece {
    /// The object without long arrays.
    Frame,
    /// Elements of the object's array of this name, with commas between them.
    Rows(String),
}

/// An object with long arrays.
pub trait Long: Serialize + DeserializeOwned {
    /// Names of the arrays.
    const ROWS: &'static [&'static str];

    /// Adds elements to the array of this name, from their text.
    ///
    /// # Errors
    /// Where the text is another one's: what was found.
    fn add(&mut self, name: &str, rows: &[u8]) -> Result<(), String>;

    /// The object without what is in its long arrays.
    #[must_use]
    fn frame(&self) -> Self;

    /// The text of at most so many elements of the array of this name from a place on, as [`Self::add`] reads it; none from its end on.
    fn rows(&self, name: &str, from: usize, most: usize) -> Option<Vec<u8>>;
}

macro_rules! long {
    ($object:ty: $($rows:ident),*) => {
        impl Long for $object {
            const ROWS: &'static [&'static str] = &[$(stringify!($rows)),*];

            fn add(&mut self, name: &str, rows: &[u8]) -> Result<(), String> {
                match name {
                    $(stringify!($rows) => extend(&mut self.$rows, rows),)*
                    _ => Err(format!("no array {name}")),
                }
            }

            fn frame(&self) -> Self {
                let mut frame = self.clone();
                $(frame.$rows.clear();)*
                frame
            }

            fn rows(&self, name: &str, from: usize, most: usize) -> Option<Vec<u8>> {
                match name {
                    $(stringify!($rows) => some(&self.$rows, from, most),)*
                    _ => None,
                }
            }
        }
    };
}

long!(Project: photos, points, observations);
long!(Adjustment: photos, points, observations);

fn extend<T: DeserializeOwned>(all: &mut Vec<T>, rows: &[u8]) -> Result<(), String> {
    all.append(&mut from_bytes(&[b"[", rows, b"]"].concat())?);
    Ok(())
}

fn some<T: Serialize>(all: &[T], from: usize, most: usize) -> Option<Vec<u8>> {
    let rows = all.get(from..(from + most).min(all.len())).filter(|rows| !rows.is_empty())?;
    let mut text = to_bytes(&rows);
    // the brackets
    text.pop();
    text.remove(0);
    Some(text)
}

/// An object in pieces, each written when it is asked for.
pub fn written<T: Long>(object: &T) -> impl Iterator<Item = (Piece, Vec<u8>)> {
    let frame = std::iter::once_with(|| (Piece::Frame, to_bytes(&object.frame())));
    let rows = T::ROWS.iter().flat_map(move |name| {
        let places = (0..).map(|k| k * ROWS_AT_ONCE);
        let texts = places.map_while(move |from| object.rows(name, from, ROWS_AT_ONCE));
        texts.map(|text| (Piece::Rows((*name).to_owned()), text))
    });
    frame.chain(rows)
}

/// An object from its pieces, at once.
///
/// # Errors
/// Where the texts are another object's: what was found.
pub fn from_pieces<'a, T: Long>(pieces: &[Piece], texts: impl Iterator<Item = &'a [u8]> + Clone) -> Result<T, String> {
    if pieces.len() != texts.clone().count() {
        return Err(format!("{} texts of {} pieces", texts.count(), pieces.len()));
    }
    let all = || pieces.iter().zip(texts.clone());
    let frame = all().filter(|(piece, _)| **piece == Piece::Frame).flat_map(|(_, text)| text.to_vec());
    let mut object = from_bytes::<T>(&frame.collect::<Vec<_>>())?;
    for (piece, text) in all() {
        if let Piece::Rows(name) = piece {
            object.add(name, text)?;
        }
    }
    Ok(object)
}

#[cfg(test)]
mod tests {
    use sightline::adjustment::{AdjustedObservation, AdjustedPoint};

    use super::*;

    /// An adjustment whose texts look like what is between them.
    fn adjustment(rows: usize) -> Adjustment {
        let point = |k| AdjustedPoint {
            id: format!("p{k}\\\"],[{{"),
            xyz: [0.1 * k as f64, 1e-300, -0.0],
            ..Default::default()
        };
        let observation = |k| AdjustedObservation {
            photo: r#""observations":["#.into(),
            point: format!("점 {k},\\"),
            vx: Some(1.0 / (k as f64 + 3.0)),
            ..Default::default()
        };
        Adjustment {
            points: (0..rows).map(point).collect(),
            observations: (0..rows).map(observation).collect(),
            sigma0: Some(0.1 + 0.2),
            ..Adjustment::default()
        }
    }

    fn read<T: Long>(pieces: &[Piece], parts: &[Vec<u8>]) -> Result<T, String> {
        from_pieces(pieces, parts.iter().map(Vec::as_slice))
    }

    #[test]
    fn pieces_written_one_by_one_give_the_object_back() {
        for rows in [0, 1, ROWS_AT_ONCE, 2 * ROWS_AT_ONCE + 1] {
            let object = adjustment(rows);
            let (pieces, parts): (Vec<_>, Vec<_>) = written(&object).unzip();
            assert_eq!(pieces.len(), 1 + 2 * rows.div_ceil(ROWS_AT_ONCE));
            assert_eq!(read::<Adjustment>(&pieces, &parts).unwrap(), object, "{rows}");
            assert!(read::<Adjustment>(&pieces, &parts[1..]).is_err(), "{rows}");
        }
    }

    #[test]
    fn a_piece_of_something_else_is_refused() {
        let mut object = adjustment(1);
        assert!(object.add("observations", br#"{"photo":1}"#).is_err());
        assert!(object.add("cameras", b"").is_err());
    }
}
