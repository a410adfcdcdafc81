//! What measures are resolved against.

use crate::absorber::construction::shape;
use crate::absorber::{Cooling, Declaration, Medium, Mounted};
use crate::crankshaft::FatigueSpec;
use crate::drivetrain::Chain;
use crate::engine::Order;
use crate::input::error::{At, Check};
use crate::input::schema::measure::{RawOver, RawPairs, RawWithin};
use crate::input::validation::absorbers::DesignSpec;
use crate::input::validation::family::AbsorberSpec;
use crate::input::validation::named::station;
use crate::input::validation::optimise::OptimiseSpec;
use crate::objective::{Over, Within};
use crate::response::Quantity;

/// The twist reported where a study names none: from the hub to the last station, or over the whole chain where the hub is the last; to
/// the ground where there is one station only.
pub(crate) fn default_twist(chain: &Chain, hub: usize) -> Quantity {
    let last = chain.len() - 1;
    Quantity::Twist { from: if hub == last { 0 } else { hub }, to: (last > 0).then_some(last) }
}

/// What a study says of fatigue.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Judged<'a> {
    /// Nothing.
    Not,
    /// With mistakes.
    Wrongly,
    /// This.
    By(&'a FatigueSpec),
}

impl<'a> Judged<'a> {
    /// Of what was asked and what came of it.
    pub fn new(asked: bool, spec: Option<&'a FatigueSpec>) -> Self {
        match (asked, spec) {
            (false, _) => Self::Not,
            (true, None) => Self::Wrongly,
            (true, Some(spec)) => Self::By(spec),
        }
    }
}

/// What measures are resolved against.
#[derive(Clone, Copy)]
pub(crate) struct Context<'a> {
    pub chain: &'a Chain,
    pub fatigue: Judged<'a>,
    /// Station of the first absorber.
    pub hub: usize,
    /// Lowest and highest speed, rpm.
    pub speeds: (f64, f64),
    /// Highest order.
    pub order_limit: f64,
    /// 2 or 4.
    pub strokes: u32,
    /// Most absorbers of a design.
    pub absorbers: usize,
    /// Of each absorber what cools it, one for every type that is optimised and every design; or those that do not say.
    pub cooled: &'a [Result<Vec<Cooling>, Vec<String>>],
    /// Absorbers whose temperature or strain is balanced, of any design and of what is optimised.
    pub balanced: &'a [usize],
    /// Of each absorber whether every type that is optimised and every design says how many cycles of strain it bears.
    pub lives: &'a [bool],
    /// Of each absorber what carries its ring, in every type and design of it that is given by its dimensions.
    pub media: &'a [Vec<Medium>],
    /// Whether a catalogue has rows that could not be read, and no other design was.
    pub unread: bool,
    /// Whether the study has a duty.
    pub has_duty: bool,
    /// Whether a condition has cylinders that differ.
    pub unequal: bool,
}

impl<'a> Context<'a> {
    /// Most absorbers of a design: of those given and of what is optimised.
    pub fn absorbers(designs: impl Iterator<Item = usize>, optimise: Option<&OptimiseSpec>) -> usize {
        designs.chain(optimise.map(|o| o.absorbers.len())).max().unwrap_or(0)
    }

    /// Of each absorber what cools it, in all that is optimised there and in every design that has it; or the designs and types that do not say.
    pub fn cooled(designs: &[&DesignSpec], optimise: Option<&OptimiseSpec>) -> Vec<Result<Vec<Cooling>, Vec<String>>> {
        let of_law = |m: &Mounted| Some(m.absorber.law()?.material()?.thermal?.cooling);
        let of_type = |a: &AbsorberSpec, t: &'static Declaration| a.materials.iter().find(|m| m.0 == t)?.1.cooling;
        let searched = |i: usize| {
            let types = optimise.and_then(|o| o.absorbers.get(i)).into_iter().flat_map(|a| a.types.iter().map(move |t| (a, *t)));
            types.map(move |(a, t)| of_type(a, t).ok_or_else(|| format!("`{}` of [optimise]", t.name)))
        };
        let given = |i: usize| {
            let with = designs.iter().filter_map(move |d| Some((d, d.absorbers.get(i)?)));
            with.map(move |(d, m)| of_law(m).ok_or_else(|| format!("design `{}`", d.name)))
        };
        let count = Self::absorbers(designs.iter().map(|d| d.absorbers.len()), optimise);
        let told = |i: usize| {
            let (said, silent): (Vec<_>, Vec<_>) = searched(i).chain(given(i)).partition(Result::is_ok);
            if silent.is_empty() {
                Ok(said.into_iter().flatten().collect())
            } else {
                Err(silent.into_iter().filter_map(Result::err).collect())
            }
        };
        (0..count).map(told).collect()
    }

    /// Absorbers whose material says what cools it, or how it follows its strain: one of a design.
    pub fn balanced(designs: &[&DesignSpec], optimise: Option<&OptimiseSpec>) -> Vec<usize> {
        let searched = |a: &AbsorberSpec| a.materials.iter().any(|m| m.1.cooling.is_some() || m.1.amplitude.is_some());
        let families = optimise.into_iter().filter_map(|o| o.absorbers.iter().position(searched));
        designs.iter().filter_map(|d| d.absorbers.iter().position(|m| m.absorber.follows_motion())).chain(families).collect()
    }

    /// Of each absorber whether all that is optimised there and every design that has it says how many cycles of strain it bears.
    pub fn lives(designs: &[&DesignSpec], optimise: Option<&OptimiseSpec>) -> Vec<bool> {
        let of_law = |m: &Mounted| m.absorber.law().and_then(|l| l.material()).is_some_and(|m| m.life.is_some() && m.geometry.is_some());
        let of_type = |a: &AbsorberSpec, t: &'static Declaration| {
            a.materials.iter().any(|m| m.0 == t && m.1.life.is_some() && m.1.geometry.is_some())
        };
        let searched =
            |i: usize| optimise.and_then(|o| o.absorbers.get(i)).into_iter().flat_map(|a| a.types.iter().map(move |t| of_type(a, t)));
        let given = |i: usize| designs.iter().filter_map(move |d| d.absorbers.get(i)).map(of_law);
        (0..Self::absorbers(designs.iter().map(|d| d.absorbers.len()), optimise))
            .map(|i| searched(i).chain(given(i)).all(|said| said))
            .collect()
    }

    /// Of each absorber what carries its ring, in every type and design of it that is given by its dimensions.
    pub fn media(designs: &[&DesignSpec], optimise: Option<&OptimiseSpec>) -> Vec<Vec<Medium>> {
        let count = Self::absorbers(designs.iter().map(|d| d.absorbers.len()), optimise);
        let medium = |t: &'static Declaration| shape(t).map(|s| s.medium);
        let searched = |i: usize| optimise.and_then(|o| o.absorbers.get(i)).into_iter().flat_map(|a| a.types.iter().copied());
        let given = |i: usize| designs.iter().filter_map(move |d| d.absorbers.get(i)?.absorber.declaration());
        (0..count).map(|i| searched(i).chain(given(i)).filter_map(medium).collect()).collect()
    }

    pub(super) fn shaft(&self, check: &mut Check, name: &At<String>) -> Option<usize> {
        let found = station(check, self.chain, name)?;
        if self.chain.next(found) >= self.chain.len() {
            check.wrong(name, format!("found the last station `{}`, expected one from which a shaft leads on", name.get_ref()));
            return None;
        }
        Some(found)
    }

    /// Rings of one absorber (from 1 in the file), or of all.
    pub(super) fn rings(&self, check: &mut Check, named: Option<&At<i64>>) -> Option<Vec<Quantity>> {
        let Some(named) = named else { return Some((0..self.absorbers.max(1)).map(Quantity::RingTwist).collect()) };
        let index = usize::try_from(*named.get_ref()).ok().filter(|i| (1..=self.absorbers).contains(i));
        if index.is_none() {
            let expected = match self.absorbers {
                // told of its table
                0 if self.unread => return None,
                0 => "no design with an absorber was read".to_owned(),
                1 => "expected 1, the only one".to_owned(),
                most => format!("expected one from 1 to {most}"),
            };
            check.wrong(named, format!("found absorber {}, {expected}", named.get_ref()));
        }
        index.map(|i| vec![Quantity::RingTwist(i - 1)])
    }

    pub(super) fn over(&self, check: &mut Check, over: Option<RawOver>, order: Option<&At<f64>>) -> Over {
        let Some(order) = order else {
            return match over.unwrap_or_default() {
                RawOver::Synthesis => Over::Synthesis,
                RawOver::Orders => Over::Orders,
                RawOver::Duty => Over::Mean,
                RawOver::Statistic(statistic) => Over::Statistic(statistic),
            };
        };
        if over.is_some() {
            check.wrong(order, "found `order` beside `over`, expected one of them");
        }
        let (twice, step) = (2.0 * order.get_ref(), f64::from(4 / self.strokes));
        let exists = twice > 0.0 && (twice / step).fract() == 0.0 && *order.get_ref() <= self.order_limit;
        if !exists {
            let expected = format!("expected a multiple of {} up to the study's limit of {}", 0.5 * step, self.order_limit);
            check.wrong(order, format!("found order {}, {expected}", order.get_ref()));
            return Over::Orders;
        }
        Over::Order(Order::from_twice(twice as u32))
    }

    /// Pairs of numbers whose first ones ascend.
    fn pairs(check: &mut Check, raw: &RawPairs, expected: &str) -> Vec<(f64, f64)> {
        let mut list = Vec::new();
        for pair in raw.get_ref() {
            match pair.get_ref().as_slice() {
                [a, b] => {
                    let (a, b) = (check.positive(a), check.positive(b));
                    if list.last().is_some_and(|l: &(f64, f64)| a <= l.0) {
                        check.wrong(pair, format!("found {a} after {}, expected ascending speeds", list[list.len() - 1].0));
                    }
                    list.push((a, b));
                }
                other => check.wrong(pair, format!("found {} numbers, expected {expected}", other.len())),
            }
        }
        list
    }

    /// Speeds that a measure leaves out, as typed.
    pub(super) fn excepted(raw: RawWithin) -> Vec<(f64, f64)> {
        let pairs = raw.except_rpm.into_iter().flat_map(|pairs| pairs.get_ref());
        let ends = |pair: &At<Vec<At<f64>>>| match pair.get_ref().as_slice() {
            [a, b] => Some((*a.get_ref(), *b.get_ref())),
            _ => None,
        };
        pairs.filter_map(ends).collect()
    }

    pub(super) fn within(&self, check: &mut Check, raw: RawWithin) -> Within {
        let mut ranges = Vec::new();
        if let Some(pair) = raw.speed_rpm {
            match pair.get_ref().as_slice() {
                [a, b] => {
                    let (low, high) = (check.positive(a), check.positive(b));
                    if low >= high {
                        check.wrong(pair, format!("found {low} to {high} rpm, expected the lower speed first"));
                    } else if !(self.speeds.0 <= low && low < high && high <= self.speeds.1) {
                        let (from, to) = self.speeds;
                        check.wrong(pair, format!("found {low} to {high} rpm, expected a part of the study's {from} to {to} rpm"));
                    }
                    ranges = vec![(low, high)];
                }
                other => check.wrong(pair, format!("found {} numbers, expected the lowest and the highest speed", other.len())),
            }
        }
        if let Some(raw) = raw.except_rpm {
            let barred = Self::pairs(check, raw, "the ends of a barred range");
            if let Some((a, b)) = barred.iter().find(|b| b.0 >= b.1) {
                check.wrong(raw, format!("found a barred range from {a} to {b} rpm, expected its lower end first"));
            }
            let whole = ranges.first().copied().unwrap_or(self.speeds);
            if let Some((a, b)) = barred.iter().find(|b| b.0 < b.1 && (b.1 <= whole.0 || b.0 >= whole.1)) {
                let (from, to) = whole;
                check.wrong(
                    raw,
                    format!("found a barred range from {a} to {b} rpm, expected one within the speeds that count, {from} to {to} rpm"),
                );
            }
            let (mut left, mut from) = (Vec::new(), whole.0);
            for (low, high) in barred {
                if low > from && from < whole.1 {
                    left.push((from, low.min(whole.1)));
                }
                from = from.max(high);
            }
            if from < whole.1 {
                left.push((from, whole.1));
            }
            if left.is_empty() {
                check.wrong(raw, "found barred ranges that leave no speed, expected some");
            }
            ranges = left;
        }
        let factors = raw.factor_by_speed.map_or_else(Vec::new, |raw| Self::pairs(check, raw, "a speed and a factor"));
        Within { ranges, factors }
    }

    /// The rings that a measure is of, in words: of their sum where none is named.
    pub(super) fn ring_words(named: Option<&At<i64>>) -> String {
        named.map_or_else(|| "all absorbers".into(), |i| format!("absorber {}", i.get_ref()))
    }

    /// The same of a measure that is largest over the rings where none is named.
    pub(super) fn each_ring(named: Option<&At<i64>>) -> String {
        named.map_or_else(|| "every absorber".into(), |i| format!("absorber {}", i.get_ref()))
    }
}
