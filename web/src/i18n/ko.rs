//! The texts in Korean, in the terms of the field: 광속조정, 표정, 잔차, 표준오차, 자유망.
//!
//! `{n}` is a value; `{n:을|를}` is the particle that follows it, as it is read: after a final consonant, or after a vowel.

use sightline::error::{Damage, Lack, PictureKind, Reason, Thing};
use sightline::initial::Degeneracy;
use sightline::project::ReportLanguage;
use sightline_report::texts::particles::after as choose;

use super::reasons;

mod adjusting;
mod background;
mod calibrating;
mod changes;
mod comparing;
mod control;
mod equipment;
mod errors;
mod experiments;
mod first;
mod general;
mod grids;
mod inside;
mod interchange;
mod lists;
mod modelling;
mod monitoring;
mod mounted;
mod names;
mod object;
mod photos;
mod planning;
mod printing;
mod projects;
mod reports;
mod results;
mod systematic;
mod targets;

/// This language.
pub struct Korean;

impl super::Speech for Korean {
    fn tag(&self) -> &'static str {
        "ko"
    }
    fn name(&self) -> &'static str {
        "한국어"
    }
    fn pages(&self) -> ReportLanguage {
        ReportLanguage::Korean
    }
    fn ignored(&self, name: &str) -> String {
        interchange::ignored(name).unwrap_or(name).to_owned()
    }
    fn reason(&self, reason: &Reason) -> String {
        reasons::reason(reason)
    }
    fn damage(&self, damage: &Damage) -> String {
        reasons::damage(damage)
    }
    fn degeneracy(&self, degeneracy: &Degeneracy) -> String {
        reasons::degeneracy(degeneracy)
    }
    fn picture(&self, kind: &PictureKind) -> String {
        reasons::picture(kind)
    }
    fn thing(&self, thing: Thing) -> &'static str {
        reasons::thing(thing)
    }
    fn lack(&self, lack: Lack) -> &'static str {
        reasons::lack(lack)
    }
}
