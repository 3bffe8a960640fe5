//! Identifiers are text; numbers are accepted too, since many point lists have nothing else.

use serde::{Deserialize, Deserializer};

#[derive(Deserialize)]
#[serde(untagged)]
enum Identifier {
    Text(String),
    Whole(i64),
    Number(f64),
}

impl Identifier {
    fn text(self) -> String {
        match self {
            Self::Text(text) => text,
            Self::Whole(number) => number.to_string(),
            Self::Number(number) => number.to_string(),
        }
    }
}

/// Text or a number.
pub fn identifier<'de, D: Deserializer<'de>>(deserializer: D) -> Result<String, D::Error> {
    Identifier::deserialize(deserializer).map(Identifier::text)
}

/// A list of texts or numbers.
pub fn identifiers<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<String>, D::Error> {
    Ok(Vec::<Identifier>::deserialize(deserializer)?.into_iter().map(Identifier::text).collect())
}

/// A list of texts or numbers, or null.
pub fn identifier_option_list<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<Vec<String>>, D::Error> {
    let list = Option::<Vec<Identifier>>::deserialize(deserializer)?;
    Ok(list.map(|ids| ids.into_iter().map(Identifier::text).collect()))
}
