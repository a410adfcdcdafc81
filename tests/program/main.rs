//! What a user of the program meets: commands, answers, files, pages, messages; and the rules of the code itself. "Equals itself" and "equals the literature" are told apart in each test's first line.
#![expect(clippy::disallowed_methods, reason = "tests hold results against the elementary functions of the standard library")]

mod answer_screen;
mod bad_input;
mod campaigns;
mod campaigns_at_scale;
mod campaigns_killed;
mod commands;
mod crank_page;
mod curves;
mod dissertations;
mod fit;
mod folders;
mod hostile;
mod layering;
mod limit_tables;
mod long;
mod new;
mod order_sheets;
mod overrides;
mod page;
mod platforms;
mod plausibility;
mod proof_tables;
mod report;
#[path = "../support.rs"]
mod support;
mod surface;
mod survival;
mod tables;
mod threads;
mod versions;
