//! Every response method on every scenario of the stability map, with the outcome each pair declares: right within a tolerance, refused by name,
//! or known to be wrong by at least some share. A new method needs its outcomes only.

use hartog::assess::stability::scenarios;

#[test]
fn every_method_on_every_scenario() {
    let mut failed = Vec::new();
    for scenario in scenarios() {
        for cell in scenario.cells() {
            println!("{:<34} {:<18} {:?}: {:?}", scenario.name, cell.candidate.label(), cell.declared, cell.found);
            if !cell.as_declared() {
                failed.push(format!("{}, {}: {:?}, found {:?}", scenario.name, cell.candidate.label(), cell.declared, cell.found));
            }
        }
    }
    assert!(failed.is_empty(), "{failed:#?}");
}
