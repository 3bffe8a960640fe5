//! The page's module as it is handed out comes in parts, so that it stands early: what a function that is marked here needs, and
//! nothing else does, lies in a part of its own (`xtask/src/parts.rs` cuts them). While the page is worked on it is one.

/// A part did not come.
pub use leptos::wasm_split::SplitLoaderError as Absent;

/// `part! { name, fn f(x: X) -> Y, { … } }` is an asynchronous function whose part is loaded by its first call, and which fails where
/// that fails; with `fetched by g` after the type `g` loads the part alone: then the first look at `f` finds it done.
macro_rules! part {
    ($part:ident, fn $name:ident($($value:ident: $type:ty),*) -> $result:ty, $(fetched by $fetch:ident,)? $body:block) => {
        #[cfg(in_parts)]
        #[leptos::wasm_split::wasm_split(
            $part, wasm_split_path = leptos::wasm_split, fallible $(, preload($fetch))?
        )]
        fn $name($($value: $type),*) -> Result<$result, $crate::parts::Absent> {
            Ok($body)
        }

        #[cfg(not(in_parts))]
        async fn $name($($value: $type),*) -> Result<$result, $crate::parts::Absent> {
            Ok($body)
        }

        $(
            #[cfg(not(in_parts))]
            async fn $fetch() -> Result<(), $crate::parts::Absent> {
                Ok(())
            }
        )?
    };
}
pub(crate) use part;
