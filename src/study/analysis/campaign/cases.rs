//! The cases of a campaign by their numbers: which values each has, and which cases a shard has.

use super::points::points;
use crate::input::campaign::{Axis, Campaign, Platform, Sample, Variant};
use crate::input::{InputError, Study, overrides, read_with};
use std::ops::Range;
use std::path::Path;

/// A case.
#[derive(Debug, Clone, PartialEq)]
pub struct Case {
    /// From 0.
    pub number: usize,
    /// Index of its value of each axis.
    pub variants: Vec<usize>,
    /// The same of each axis that a platform covers, of one of its studies; none of the whole platform.
    pub covered: Vec<usize>,
    /// Of each sampled key.
    pub values: Vec<f64>,
}

/// Cases of one shard: all have the same value of the first axis.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Shard {
    /// Value of the first axis; `None` where there is no axis.
    pub partition: Option<usize>,
    /// Its cases.
    pub cases: Range<usize>,
}

impl Campaign {
    fn samples(&self) -> usize {
        self.sample.as_ref().and_then(Sample::count).unwrap_or(1)
    }

    /// The studies of a case: one, or those that its platform covers, engine by engine.
    #[doc(hidden)]
    pub fn members(&self, case: &Case) -> Vec<Case> {
        let axes: Vec<&Axis> = self.platform.iter().flat_map(Platform::axes).collect();
        let count = self.platform.as_ref().map_or(1, Platform::studies);
        (0..count).map(|i| Case { covered: values_of(&axes, i), ..case.clone() }).collect()
    }

    /// How many combinations of what varies there are.
    #[doc(hidden)]
    pub fn combinations(&self) -> usize {
        self.axes.iter().map(|a| a.variants.len()).product()
    }

    /// Cases by their numbers.
    #[doc(hidden)]
    pub fn cases_of(&self, range: Range<usize>) -> Vec<Case> {
        let samples = self.samples();
        let mut list = Vec::with_capacity(range.len());
        let mut at = range.start;
        while at < range.end {
            let (combination, first) = (at / samples, at % samples);
            let last = (first + range.end - at).min(samples);
            let variants = values_of(&self.axes.iter().collect::<Vec<_>>(), combination);
            let values = self.sample.as_ref().map_or_else(|| vec![Vec::new(); last - first], |s| points(s, first..last));
            for (i, values) in values.into_iter().enumerate() {
                list.push(Case { number: at + i, variants: variants.clone(), covered: Vec::new(), values });
            }
            at += last - first;
        }
        list
    }

    /// A range of cases cut where another combination of what varies begins.
    pub(super) fn by_combination(&self, range: Range<usize>) -> Vec<Range<usize>> {
        let (samples, mut list, mut at) = (self.samples(), Vec::new(), range.start);
        while at < range.end {
            let end = ((at / samples + 1) * samples).min(range.end);
            list.push(at..end);
            at = end;
        }
        list
    }

    /// The first case of each combination.
    #[doc(hidden)]
    pub fn first_cases(&self) -> impl Iterator<Item = Case> {
        let samples = self.samples();
        (0..self.combinations()).flat_map(move |i| self.cases_of(i * samples..i * samples + 1))
    }

    /// Values of the first axis, cases of each, and shards of these of at most so many cases.
    fn parts(&self, most: usize) -> (usize, usize, usize) {
        let parts = self.axes.first().map_or(1, |a| a.variants.len());
        let each = self.cases().unwrap_or(0) / parts;
        (parts, each, each.div_ceil(most.max(1)))
    }

    /// How many shards of at most so many cases there are.
    #[doc(hidden)]
    pub fn shards(&self, most: usize) -> usize {
        let (parts, _, own) = self.parts(most);
        parts * own
    }

    /// One of them; `None` where there are fewer.
    #[doc(hidden)]
    pub fn shard(&self, most: usize, number: usize) -> Option<Shard> {
        let (parts, each, own) = self.parts(most);
        let (p, start) = (number.checked_div(own)?, number.checked_rem(own)? * most);
        let cases = p * each + start..p * each + (start + most).min(each);
        (p < parts).then(|| Shard { partition: (!self.axes.is_empty()).then_some(p), cases })
    }

    /// What its cases are, in words that do not depend on where files are: names of axes with their labels, keys of the sample, and how many points there are.
    #[doc(hidden)]
    pub fn expanded(&self) -> String {
        let axes =
            self.all_axes().map(|a| format!("{}: {}", a.name, a.variants.iter().map(|v| v.label.as_str()).collect::<Vec<_>>().join(", ")));
        let keys = self.sample.iter().flat_map(|s| &s.keys).map(|k| k.key.clone());
        axes.chain(keys).chain([self.samples().to_string()]).collect::<Vec<_>>().join("; ")
    }

    fn chosen<'c>(&'c self, case: &Case) -> impl Iterator<Item = &'c Variant> {
        let own: Vec<&Variant> =
            self.all_axes().zip(case.variants.iter().chain(&case.covered)).map(|(axis, i)| &axis.variants[*i]).collect();
        own.into_iter()
    }

    /// Labels of the values of the axes of a case, then of what it is of those that a platform covers.
    #[doc(hidden)]
    pub fn labels(&self, case: &Case) -> Vec<&str> {
        self.chosen(case).map(|v| v.label.as_str()).collect()
    }

    /// The study file of a case: of several variants that name one the last.
    pub(super) fn study_of(&self, case: &Case) -> &Path {
        let named = self.chosen(case).filter_map(|v| v.study.as_deref()).last();
        named.or(self.study.as_deref()).unwrap_or(&self.path)
    }

    /// What a case gives other values, in the order of the axes, then of the sample.
    fn set_of(&self, case: &Case) -> Vec<String> {
        let varied = self.chosen(case).flat_map(|v| &v.set).map(|o| o.text().to_owned());
        let keys = self.sample.iter().flat_map(|s| &s.keys);
        varied.chain(keys.zip(&case.values).map(|(key, value)| format!("{}={}", key.key, told(*value)))).collect()
    }

    /// Reads and checks the study of a case.
    ///
    /// # Errors
    /// [`InputError`] with every mistake.
    #[doc(hidden)]
    pub fn study_of_case(&self, case: &Case) -> Result<Study, InputError> {
        read_with(self.study_of(case), &overrides(&self.set_of(case))?)
    }
}

/// Indices of the values of some axes of a combination, the last one changing fastest.
fn values_of(axes: &[&Axis], mut combination: usize) -> Vec<usize> {
    let mut list = vec![0; axes.len()];
    for (own, axis) in list.iter_mut().zip(axes).rev() {
        *own = combination % axis.variants.len();
        combination /= axis.variants.len();
    }
    list
}

/// A number as it stands in a file: a whole one is one, which keys of any number take.
fn told(x: f64) -> String {
    const WHOLE: f64 = 1e15;
    if x.fract() == 0.0 && x.abs() < WHOLE { format!("{x}") } else { format!("{x:?}") }
}
