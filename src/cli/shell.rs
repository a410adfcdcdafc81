//! What a shell and its manual are given: completions and pages of every command.

use super::exit::{BAD_INPUT, DONE, fail, say, say_raw};
use crate::report::{Folder, Job, Names};
use std::path::Path;

/// Prints what a shell needs to complete commands and options.
pub fn completions(shell: clap_complete::Shell, command: &mut clap::Command) -> u8 {
    let mut text = Vec::new();
    clap_complete::generate(shell, command, "hartog", &mut text);
    match String::from_utf8(text) {
        Ok(text) => {
            say_raw(&text);
            DONE
        }
        Err(_) => BAD_INPUT,
    }
}

/// Writes a manual page of the program and of each command.
pub fn manual(folder: &Path, command: &mut clap::Command) -> u8 {
    command.build();
    let pages: Vec<clap_mangen::Man> =
        std::iter::once(&*command).chain(command.get_subcommands()).map(|c| clap_mangen::Man::new(c.clone())).collect();
    let own = Names::given("man", pages.iter().map(clap_mangen::Man::get_filename));
    let written = Folder::create(folder, Job { names: &own, inputs: &[], reads: &[] }).map_err(|e| e.to_string()).and_then(|folder| {
        for man in &pages {
            let mut page = Vec::new();
            man.render(&mut page).map_err(|e| e.to_string())?;
            folder.write(&man.get_filename(), &page).map_err(|e| e.to_string())?;
        }
        folder.close();
        Ok(folder.written())
    });
    match written {
        Ok(count) => {
            say(&format!("{count} pages in {0}: read one with `man {0}/hartog-run.1`\n", folder.display()));
            DONE
        }
        Err(error) => fail(&error),
    }
}
