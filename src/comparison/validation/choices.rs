//! Which designs are better: as a publication has it and as computed, by every measure that its tables hold, pair by pair; and what it recommends.

use super::{Entry, Kind};
use crate::input::published::PublishedChoice;
use crate::input::{Published, Study};
use std::cmp::Ordering;

/// A design by one measure; the smaller value is better, but for a margin.
#[derive(Debug, Clone, PartialEq)]
pub struct Placed {
    /// Name.
    pub design: String,
    /// As printed.
    pub published: f64,
    /// Ours.
    pub computed: f64,
}

/// Designs by one measure.
#[derive(Debug, Clone, PartialEq)]
pub struct Ranking {
    /// What kind of measure it is.
    pub kind: Kind,
    /// What it is.
    pub quantity: String,
    /// Its unit.
    pub unit: String,
    /// Designs with a printed value and ours, as the study lists them.
    pub designs: Vec<Placed>,
}

/// Pairs of designs in printed order.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Agreement {
    /// Whose order is printed.
    pub pairs: usize,
    /// Of these, ours are in the same order.
    pub agree: usize,
    /// Printed alike, to the digit: they say nothing.
    pub tied: usize,
}

impl Agreement {
    /// Of several rankings together.
    pub fn of<'a>(rankings: impl IntoIterator<Item = &'a Ranking>) -> Self {
        rankings.into_iter().fold(Self::default(), |sum, r| {
            let own = r.agreement();
            Self { pairs: sum.pairs + own.pairs, agree: sum.agree + own.agree, tied: sum.tied + own.tied }
        })
    }
}

impl Ranking {
    /// Every pair of designs: the one printed as better first, and whether ours is in the same order; `None` for that where they are printed alike.
    pub fn pairs(&self) -> Vec<([&Placed; 2], Option<bool>)> {
        let better = |a: f64, b: f64| if self.kind.is_margin() { b.total_cmp(&a) } else { a.total_cmp(&b) };
        let mut list = Vec::new();
        for (i, a) in self.designs.iter().enumerate() {
            for b in &self.designs[i + 1..] {
                list.push(match better(a.published, b.published) {
                    Ordering::Equal => ([a, b], None),
                    Ordering::Less => ([a, b], Some(better(a.computed, b.computed).is_lt())),
                    Ordering::Greater => ([b, a], Some(better(b.computed, a.computed).is_lt())),
                });
            }
        }
        list
    }

    /// How many pairs agree.
    #[doc(hidden)]
    pub fn agreement(&self) -> Agreement {
        self.pairs().iter().fold(Agreement::default(), |sum, (_, agrees)| match agrees {
            None => Agreement { tied: sum.tied + 1, ..sum },
            Some(agrees) => Agreement { pairs: sum.pairs + 1, agree: sum.agree + usize::from(*agrees), ..sum },
        })
    }

    /// Place of a design from 1, by what is printed or by ours; those alike share the better place.
    pub fn place(&self, design: &Placed, value: fn(&Placed) -> f64) -> usize {
        let ahead = |other: &&Placed| if self.kind.is_margin() { value(other) > value(design) } else { value(other) < value(design) };
        1 + self.designs.iter().filter(ahead).count()
    }
}

/// A recommended design.
#[derive(Debug, Clone, PartialEq)]
pub struct Chosen {
    /// What is recommended.
    pub choice: PublishedChoice,
    /// Its name.
    pub design: String,
}

/// Which designs are better.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Choices {
    /// By every measure that is printed for at least two designs.
    pub rankings: Vec<Ranking>,
    /// What the publication recommends.
    pub chosen: Vec<Chosen>,
}

/// The rankings that entries hold, and what is recommended.
pub fn choices(study: &Study, published: &Published, entries: &[Entry]) -> Choices {
    let mut rankings: Vec<Ranking> = Vec::new();
    let ranked = entries.iter().filter(|e| e.kind.is_ranked());
    for e in ranked {
        let (Some(published), Some(computed)) = (e.published, e.computed) else { continue };
        let placed = Placed { design: e.design.clone(), published, computed };
        match rankings.iter_mut().find(|r| (r.kind, &r.quantity) == (e.kind, &e.quantity)) {
            // an order that meets two modes is ranked where it meets the first
            Some(ranking) if ranking.designs.iter().any(|d| d.design == placed.design) => {}
            Some(ranking) => ranking.designs.push(placed),
            None => {
                let (quantity, unit) = (e.quantity.clone(), e.unit.clone());
                rankings.push(Ranking { kind: e.kind, quantity, unit, designs: vec![placed] });
            }
        }
    }
    rankings.retain(|r| r.designs.len() > 1);
    let chosen = |c: &PublishedChoice| Chosen { choice: c.clone(), design: study.designs[c.design].name.clone() };
    Choices { rankings, chosen: published.choices.iter().map(chosen).collect() }
}
