//! Every word of the report in every language: one file a language, and a text missing in one does not compile.
//!
//! `en.rs` declares the texts, the files of other languages translate them. How values get into them, and Korean particles, the desk
//! takes from here.

mod en;
mod ko;
pub mod particles;
pub mod template;

pub(super) use en::Words;

use sightline::project::ReportLanguage;

/// The words of a language.
pub(super) fn words(language: ReportLanguage) -> &'static dyn Words {
    match language {
        ReportLanguage::English => &en::English,
        ReportLanguage::Korean => &ko::Korean,
    }
}

/// Name, values and template of a text, for the test of all of them.
#[cfg(test)]
type Declared = (&'static str, &'static [&'static str], &'static str);

/// Declares the texts in English: `name: "words";` or, with values, `name(a, b): "words {a} {b:one|many}";`.
macro_rules! declare {
    ($($name:ident $(($($value:ident),+))? : $text:literal;)+) => {
        /// Texts of every language.
        // A text's name may begin with any word.
        #[allow(clippy::wrong_self_convention, clippy::too_many_arguments, missing_docs)]
        pub trait Words: Sync {
            $($crate::texts::declare!(@method $name $(($($value),+))?);)+
            #[cfg(test)]
            fn every_text(&self) -> Vec<$crate::texts::Declared>;
        }
        $crate::texts::translate! { English { $($name $(($($value),+))? : $text;)+ } }
    };
    (@method $name:ident) => { fn $name(&self) -> &'static str; };
    (@method $name:ident ($($value:ident),+)) => { fn $name(&self, $($value: &dyn std::fmt::Display),+) -> String; };
}
use declare;

/// Says the texts in a language; `choose` of its file picks between two forms by the value before them.
macro_rules! translate {
    ($language:ident { $($name:ident $(($($value:ident),+))? : $text:literal;)+ }) => {
        impl $crate::texts::Words for $language {
            $($crate::texts::translate!(@method $name $(($($value),+))? $text);)+
            #[cfg(test)]
            fn every_text(&self) -> Vec<$crate::texts::Declared> {
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
            $crate::texts::template::fill($text, &[$((stringify!($value), $value)),+], choose)
        }
    };
}
use translate;

#[cfg(test)]
mod tests {
    use super::*;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    #[test]
    fn every_text_says_something_and_uses_its_values_and_no_others() {
        for language in [ReportLanguage::English, ReportLanguage::Korean] {
            for (name, values, text) in words(language).every_text() {
                assert!(!text.trim().is_empty(), "{language:?} {name}");
                let used = template::values(text).unwrap_or_else(|fault| panic!("{language:?} {name}: {fault}"));
                let declared = values.iter().map(|value| (*value).to_owned()).collect();
                assert_eq!(used, declared, "{language:?} {name}");
                for undecided in ["을(를)", "은(는)", "이(가)", "와(과)", "(으)로", "(s)"] {
                    assert!(!text.contains(undecided), "{language:?} {name}");
                }
            }
        }
    }
}
