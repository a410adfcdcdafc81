//! The attribute of functions that do one operation on many numbers.

use proc_macro::TokenStream;

/// A function that is compiled once for each width of vectors that processors have, and chosen when the program runs: with the same operations in the same order, so that results are the same on all.
/// With the feature `baseline` of the crate there is only the plain one.
#[doc(hidden)]
#[proc_macro_attribute]
pub fn kernel(_: TokenStream, function: TokenStream) -> TokenStream {
    const WIDTHS: &str = r#"#[cfg_attr(
        not(feature = "baseline"),
        multiversion::multiversion(targets("x86_64+avx512f", "x86_64+avx2", "x86_64+avx", "aarch64+neon"))
    )]"#;
    let mut attributed: TokenStream = WIDTHS.parse().unwrap_or_default();
    attributed.extend(function);
    attributed
}
