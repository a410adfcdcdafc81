//! What a shaft answers to loads at the orders and speeds of a study: solved at some speeds, between them by rational functions.
//!
//! The dynamic stiffness of an order is a polynomial of the speed, so every answer is a rational function of it, with poles that all answers of the order share.

use super::shaft::{Answer, Shaft, Turning};
use crate::numerics::C64;
use crate::numerics::block_tridiagonal::Columns;
use crate::numerics::rational::{Block, Rational};
use crate::numerics::tridiagonal::Singular;
use nalgebra::SVector;
use rayon::prelude::*;

/// What acts on a shaft: forces and moments on nodes.
pub type Load = Vec<(usize, SVector<C64, 6>)>;

/// Largest error at the samples, over the largest answer of its kind at any speed. Rounding of stiff and soft parts beside each other leaves some 1e-9.
const CLOSE: f64 = 1e-8;
/// The same at speeds between them.
const CHECKED: f64 = 1e-7;
/// Intervals between samples at first, and at most.
const FIRST: usize = 48;
const MOST: usize = 400;
/// Every so many intervals of the samples one speed between is checked.
const EVERY: usize = 5;

/// An order at a speed.
#[derive(Debug, Clone)]
pub(crate) enum Point {
    /// Between the speeds of its table.
    Shares(Vec<Block>),
    /// Solved: answers, load by load.
    Solved(Vec<C64>),
}

/// Answers to loads at the orders of a study.
#[derive(Debug)]
pub struct Transfer {
    shaft: Shaft,
    orders: Vec<f64>,
    /// Of each order.
    loads: Vec<Vec<Load>>,
    answers: Vec<Answer>,
    /// Lowest and highest speed of the tables, rad/s.
    range: (f64, f64),
    /// By order; nothing where no rational function was found.
    tables: Vec<Option<Rational>>,
}

impl Transfer {
    /// Tables of `loads` (a list for each order) between two speeds, rad/s.
    pub fn new(shaft: Shaft, orders: Vec<f64>, loads: Vec<Vec<Load>>, answers: Vec<Answer>, range: (f64, f64)) -> Self {
        let mut all = Self { shaft, orders, loads, answers, range, tables: Vec::new() };
        all.tables = (0..all.orders.len()).into_par_iter().map(|n| all.table(n)).collect();
        all
    }

    /// An order at a speed (rad/s).
    ///
    /// # Errors
    /// [`Singular`] at an undamped resonance.
    pub(crate) fn at(&self, order: usize, speed: f64) -> Result<Point, Singular> {
        match &self.tables[order] {
            Some(table) if (self.range.0..=self.range.1).contains(&speed) => Ok(Point::Shares(table.shares(speed))),
            _ => Ok(Point::Solved(self.solved(order, speed, &self.loads[order])?)),
        }
    }

    /// Answers to a factor times one of the loads of an order at a point, added to `out`; `rows`: those that are asked for, all without.
    pub(crate) fn add(&self, (load, factor): (usize, C64), order: usize, (point, rows): (&Point, Option<&[usize]>), out: &mut [C64]) {
        let first = load * self.answers.len();
        match (point, &self.tables[order], rows) {
            (Point::Shares(shares), Some(table), Some(rows)) => table.add_rows(shares, (first, rows), factor, out),
            (Point::Shares(shares), Some(table), None) => table.add(shares, first..first + self.answers.len(), factor, out),
            (Point::Solved(all), ..) => out.iter_mut().zip(&all[first..]).for_each(|(sum, y)| *sum += factor * y),
            (Point::Shares(_), None, _) => {}
        }
    }

    /// How many answers there are to a load.
    pub(crate) fn answers(&self) -> usize {
        self.answers.len()
    }

    /// Loads of an order.
    pub(crate) fn loads(&self, order: usize) -> &[Load] {
        &self.loads[order]
    }

    /// Answers to loads by a solution of their own.
    ///
    /// # Errors
    /// [`Singular`] at an undamped resonance.
    pub fn solved(&self, order: usize, speed: f64, loads: &[Load]) -> Result<Vec<C64>, Singular> {
        let factored = self.shaft.factored(Turning { omega: self.orders[order] * speed, speed })?;
        let mut x = vec![Columns::zeros(loads.len()); self.shaft.len()];
        for (column, load) in loads.iter().enumerate() {
            for (node, force) in load {
                let mut own = x[*node].column_mut(column);
                own += force;
            }
        }
        factored.solve(&mut x)?;
        let answer =
            |column: usize, answer: &Answer| -> C64 { answer.iter().map(|(node, k, factor)| x[*node][(*k, column)] * *factor).sum() };
        Ok((0..loads.len()).flat_map(|column| self.answers.iter().map(move |a| (column, a))).map(|(column, a)| answer(column, a)).collect())
    }

    /// The table of an order; `None` where no rational function is close enough.
    fn table(&self, order: usize) -> Option<Rational> {
        let (low, high) = self.range;
        let solve = |x: &f64| self.solved(order, *x, &self.loads[order]).ok();
        let mut count = FIRST;
        if high <= low {
            return None;
        }
        let place = |i: usize, count: usize| low + (high - low) * i as f64 / count as f64;
        let mut x: Vec<f64> = (0..=count).map(|i| place(i, count)).collect();
        let mut rows = x.iter().map(solve).collect::<Option<Vec<_>>>()?;
        while count <= MOST {
            if let Some(found) = Rational::through(&x, &rows, CLOSE) {
                let between: Vec<f64> = (0..count).step_by(EVERY).map(|i| 0.5 * (x[i] + x[i + 1])).collect();
                let holds = |x: &f64| solve(x).is_some_and(|row| found.error(*x, &row) <= CHECKED);
                if between.iter().all(holds) {
                    return Some(found);
                }
            }
            // halves between
            let more = (0..count).map(|i| place(2 * i + 1, 2 * count)).map(|x| Some((x, solve(&x)?))).collect::<Option<Vec<_>>>()?;
            let (mut places, mut values) = (Vec::with_capacity(2 * count + 1), Vec::with_capacity(2 * count + 1));
            let mut more = more.into_iter();
            for (own, row) in x.into_iter().zip(rows) {
                places.push(own);
                values.push(row);
                if let Some((x, row)) = more.next() {
                    places.push(x);
                    values.push(row);
                }
            }
            (x, rows) = (places, values);
            count *= 2;
        }
        None
    }
}
