//! Every word of the desk in every language: a folder a language, a file for each part of the desk, and a text missing in one does not compile.
//!
//! The files in `en` declare the texts; those of other languages translate them. A text is a function: used in a view it follows
//! the language switch by itself, for it reads the language signal. What the engine has words for, its reasons and the language
//! of its pages, every language says through [`Speech`]. A further language is its texts, its `Speech`, and its lines in the
//! enum and the macro `spoken` below; pages in it are the engine's (`report/src/texts`).

mod declared;
mod en;
pub mod errors;
mod ko;
mod name_list;
mod reasons;
pub mod text;

use leptos::prelude::*;
use sightline::error::{Damage, Lack, PictureKind, Reason, Thing};
use sightline::initial::Degeneracy;
use sightline::project::ReportLanguage;

pub use en::{
    background, calibrating, comparing, equipment, experiments, first, grids, inside, interchange, lists, modelling,
    monitoring, mounted, object, planning, printing, systematic,
};

pub use name_list::name_list;

use crate::browser::page;

/// The desk's languages.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Language {
    English,
    Korean,
}

/// A language's texts, as a trait's object.
macro_rules! spoken {
    ($in:expr) => {
        match $in {
            $crate::i18n::Language::English => &$crate::i18n::en::English,
            $crate::i18n::Language::Korean => &$crate::i18n::ko::Korean,
        }
    };
}
use spoken;

/// Texts of a language for the engine's values.
pub trait Speech {
    /// Its tag (BCP 47).
    fn tag(&self) -> &'static str;
    /// Its name in itself.
    fn name(&self) -> &'static str;
    /// The engine's own language that is nearest to it, for pages and sheets.
    fn pages(&self) -> ReportLanguage;
    /// Contents of another program's file that were not imported, by the engine's or the file's name.
    fn ignored(&self, name: &str) -> String;
    fn reason(&self, reason: &Reason) -> String;
    fn damage(&self, damage: &Damage) -> String;
    fn degeneracy(&self, degeneracy: &Degeneracy) -> String;
    fn picture(&self, kind: &PictureKind) -> String;
    fn thing(&self, thing: Thing) -> &'static str;
    fn lack(&self, lack: Lack) -> &'static str;
}

/// That of the language in use.
pub fn speech() -> &'static dyn Speech {
    language().speech()
}

thread_local! {
    static LANGUAGE: ArcRwSignal<Language> = ArcRwSignal::new(Language::English);
}

impl Language {
    pub const ALL: [Self; 2] = [Self::English, Self::Korean];

    fn speech(self) -> &'static dyn Speech {
        spoken!(self)
    }

    pub fn tag(self) -> &'static str {
        self.speech().tag()
    }

    pub fn name(self) -> &'static str {
        self.speech().name()
    }

    /// The engine's own language for its pages.
    pub fn pages(self) -> ReportLanguage {
        self.speech().pages()
    }

    /// The language that the engine's pages in one of its own are in.
    pub fn of_pages(pages: ReportLanguage) -> Self {
        Self::ALL.into_iter().find(|language| language.pages() == pages).unwrap_or(Self::English)
    }

    /// The languages that pages can be in.
    pub fn with_pages() -> impl Iterator<Item = Self> {
        Self::ALL.into_iter().filter(|language| Self::of_pages(language.pages()) == *language)
    }

    pub fn from_tag(tag: &str) -> Self {
        Self::ALL.into_iter().find(|language| tag.starts_with(language.tag())).unwrap_or(Self::English)
    }

    /// The next one in the row of languages.
    pub fn other(self) -> Self {
        let at = Self::ALL.iter().position(|language| *language == self).unwrap_or(0);
        Self::ALL[(at + 1) % Self::ALL.len()]
    }
}

/// A text of the desk.
pub type Text = fn() -> &'static str;

/// The language in use.
pub fn language() -> Language {
    LANGUAGE.with(Get::get)
}

/// Switches the language; nothing else changes.
pub fn set_language(language: Language) {
    page::set_root_attribute("lang", language.tag());
    page::set_preference("language", language.tag());
    LANGUAGE.with(|l| l.set(language));
}

/// Texts in a language, for tests.
#[cfg(test)]
pub fn in_language<T>(other: Language, said: impl FnOnce() -> T) -> T {
    let before = language();
    LANGUAGE.with(|l| l.set(other));
    let said = said();
    LANGUAGE.with(|l| l.set(before));
    said
}

/// Takes the language chosen last, or the browser's.
pub fn restore_language() {
    let tag = page::preference("language").unwrap_or_else(page::preferred_language);
    set_language(Language::from_tag(&tag));
}

/// Name, values and template of a text, for the test of all of them.
#[cfg(test)]
type Declared = (&'static str, &'static [&'static str], &'static str);

/// Declares a part's texts in English, in the file of the part's name: `name: "words";` or, with values, `name(a, b): "words {a} {b:one|many}";`.
/// Each becomes a function of the part's module, and a method of its trait `Words`, which every language implements.
macro_rules! declare {
    ($part:ident { $($(#[$for_function:meta])* $name:ident $(($($value:ident),+))? : $text:literal;)+ }) => {
        /// Texts of every language.
        // A text's name may begin with any word.
        #[allow(clippy::wrong_self_convention)]
        pub trait Words: Sync {
            $($crate::i18n::declare!(@method $name $(($($value),+))?);)+
            #[cfg(test)]
            fn every_text(&self) -> Vec<$crate::i18n::Declared>;
        }

        /// The texts in a language.
        pub fn words(language: $crate::i18n::Language) -> &'static dyn Words {
            $crate::i18n::spoken!(language)
        }

        $($crate::i18n::declare!(@function $(#[$for_function])* $name $(($($value),+))?);)+

        $crate::i18n::translate! { English $part { $($name $(($($value),+))? : $text;)+ } }
    };
    (@method $name:ident) => { fn $name(&self) -> &'static str; };
    (@method $name:ident ($($value:ident),+)) => { fn $name(&self, $($value: &dyn std::fmt::Display),+) -> String; };
    (@function $(#[$for_function:meta])* $name:ident) => {
        $(#[$for_function])*
        pub fn $name() -> &'static str {
            words($crate::i18n::language()).$name()
        }
    };
    (@function $(#[$for_function:meta])* $name:ident ($($value:ident),+)) => {
        $(#[$for_function])*
        pub fn $name($($value: impl std::fmt::Display),+) -> String {
            words($crate::i18n::language()).$name($(&$value),+)
        }
    };
}
use declare;

/// Says a part's texts in a language; `choose` of its file picks between two forms by the value before them.
macro_rules! translate {
    ($language:ident $part:ident { $($name:ident $(($($value:ident),+))? : $text:literal;)+ }) => {
        impl $crate::i18n::en::$part::Words for $language {
            $($crate::i18n::translate!(@method $name $(($($value),+))? $text);)+
            #[cfg(test)]
            fn every_text(&self) -> Vec<$crate::i18n::Declared> {
                vec![$((stringify!($name), &[$($(stringify!($value)),+)?], $text)),+]
            }
        }
    };
    (@method $name:ident $text:literal) => {
        fn $name(&self) -> &'static str {
            $text
        }
    };
    (@method $name:ident ($($value:ident),+) $text:literal) => {
        fn $name(&self, $($value: &dyn std::fmt::Display),+) -> String {
            sightline_report::texts::template::fill($text, &[$((stringify!($value), $value)),+], choose)
        }
    };
}
use translate;

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use sightline_report::texts::template;

    use super::*;

    /// Every text, in every language.
    fn all() -> Vec<(Language, Declared)> {
        let of = |language: Language| {
            let parts = [
                en::adjusting::words(language).every_text(),
                en::changes::words(language).every_text(),
                en::control::words(language).every_text(),
                en::general::words(language).every_text(),
                en::names::words(language).every_text(),
                en::photos::words(language).every_text(),
                en::projects::words(language).every_text(),
                en::reports::words(language).every_text(),
                en::results::words(language).every_text(),
                en::targets::words(language).every_text(),
                experiments::words(language).every_text(),
                printing::words(language).every_text(),
                planning::words(language).every_text(),
                en::errors::words(language).every_text(),
                object::words(language).every_text(),
                comparing::words(language).every_text(),
                equipment::words(language).every_text(),
                background::words(language).every_text(),
                monitoring::words(language).every_text(),
                interchange::words(language).every_text(),
                lists::words(language).every_text(),
                first::words(language).every_text(),
                systematic::words(language).every_text(),
                modelling::words(language).every_text(),
                calibrating::words(language).every_text(),
                mounted::words(language).every_text(),
                grids::words(language).every_text(),
                inside::words(language).every_text(),
            ];
            parts.into_iter().flatten().map(move |text| (language, text))
        };
        Language::ALL.into_iter().flat_map(of).collect()
    }

    #[test]
    fn every_text_says_something_and_uses_its_values_and_no_others() {
        let mut seen = BTreeSet::new();
        for (language, (name, values, template)) in all() {
            assert!(!template.trim().is_empty(), "{language:?} {name}");
            let used = template::values(template).unwrap_or_else(|fault| panic!("{language:?} {name}: {fault}"));
            for value in &used {
                assert!(values.contains(&value.as_str()) || values.is_empty(), "{language:?} {name}: {value}");
            }
            for value in values {
                assert!(used.contains(*value), "{language:?} {name} leaves out {value}");
            }
            seen.insert(language.tag());
        }
        assert_eq!(seen.len(), Language::ALL.len());
    }

    #[test]
    fn no_particle_is_left_to_choose_and_no_plural_to_guess() {
        for (language, (name, _, template)) in all() {
            for undecided in ["을(를)", "은(는)", "이(가)", "와(과)", "(으)로", "(s)"] {
                assert!(!template.contains(undecided), "{language:?} {name}");
            }
        }
    }

    #[test]
    fn languages_are_known_by_their_tags() {
        assert_eq!(Language::from_tag("ko-KR"), Language::Korean);
        assert_eq!(Language::from_tag("fr"), Language::English);
        assert_eq!(Language::English.other().other(), Language::English);
        for language in Language::ALL {
            assert_eq!(Language::from_tag(language.tag()), language);
            assert!(Language::ALL.iter().all(|other| *other == language || other.name() != language.name()));
        }
    }

    #[test]
    fn pages_are_in_the_language_that_was_chosen_for_them() {
        let offered: Vec<_> = Language::with_pages().collect();
        assert_eq!(offered, [Language::English, Language::Korean]);
        for language in offered {
            assert_eq!(Language::of_pages(Language::from_tag(language.tag()).pages()), language);
        }
        assert_eq!(Language::of_pages(ReportLanguage::Korean), Language::Korean);
    }
}
