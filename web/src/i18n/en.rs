//! The texts in English, by which every other language is checked: labels are noun phrases, advice is full sentences.
//!
//! `{n}` is a value; `{n:photo|photos}` is the word for one or for any other number of them.

use sightline::error::{Damage, Lack, PictureKind, Reason, Thing};
use sightline::initial::Degeneracy;
use sightline::project::ReportLanguage;

pub mod adjusting;
pub mod background;
pub mod calibrating;
pub mod changes;
pub mod comparing;
pub mod control;
pub mod equipment;
pub mod errors;
pub mod experiments;
pub mod first;
pub mod general;
pub mod grids;
pub mod inside;
pub mod interchange;
pub mod lists;
pub mod modelling;
pub mod monitoring;
pub mod mounted;
pub mod names;
pub mod object;
pub mod photos;
pub mod planning;
pub mod printing;
pub mod projects;
pub mod reports;
pub mod results;
pub mod systematic;
pub mod targets;

/// This language.
pub struct English;

impl super::Speech for English {
    fn tag(&self) -> &'static str {
        "en"
    }
    fn name(&self) -> &'static str {
        "English"
    }
    fn pages(&self) -> ReportLanguage {
        ReportLanguage::English
    }
    fn ignored(&self, name: &str) -> String {
        name.to_owned()
    }
    fn reason(&self, reason: &Reason) -> String {
        super::declared::english(reason)
    }
    fn damage(&self, damage: &Damage) -> String {
        damage.to_string()
    }
    fn degeneracy(&self, degeneracy: &Degeneracy) -> String {
        degeneracy.to_string()
    }
    fn picture(&self, kind: &PictureKind) -> String {
        kind.to_string()
    }
    fn thing(&self, thing: Thing) -> &'static str {
        thing.name()
    }
    fn lack(&self, lack: Lack) -> &'static str {
        lack.name()
    }
}

fn choose<'a>(value: &str, one: &'a str, other: &'a str) -> &'a str {
    if value == "1" { one } else { other }
}
