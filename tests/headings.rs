//! What lies where in a chain of another program: to ground, to the next station, to the one before; sums, shafts, the sequence of the rows.

use crate::dialects::{CHAIN, hartog, imported, refused, written};

/// A damping is to ground or to the next station by the words of its head, full or short; one that says neither is left out with the heads that do. What lies before a station, sums and rows of shafts are
/// refused: read as between a station and the next one they would give another chain.
#[test]
fn what_lies_where_in_a_chain() {
    let place = tempfile::tempdir().expect("a folder");
    let damped = |head: &str| CHAIN.replace('\n', ";5\n").replace("rad];5", &format!("rad];{head} [N m s/rad]")).replace("0,9;;5", "0,9;;");
    for (i, (head, ground, next)) in [
        ("Abs. Dämpfung", 5.0, 0.0),
        ("Äußere Dämpfung", 5.0, 0.0),
        ("Dämpfung gegen Gehäuse", 5.0, 0.0),
        ("Rel. Dämpfung", 0.0, 5.0),
        ("Innere Dämpfung", 0.0, 5.0),
    ]
    .into_iter()
    .enumerate()
    {
        let own = format!("own{i}");
        written(place.path(), "c.csv", damped(head));
        let (code, out, told) = hartog(place.path(), &["import", "c.csv", &own, "--throws", "crank"]);
        assert!(code == 0 && !out.contains("Left out"), "{head}: {out}{told}");
        let study = hartog::input::read(&place.path().join(own).join("study.toml")).unwrap_or_else(|e| panic!("{e}"));
        let crank = &study.chain.stations[1];
        assert_eq!((crank.damping_to_ground, crank.damping_to_next), (ground, next), "{head}");
    }
    let (_, told) = imported(damped("Dämpfung"));
    let told = told.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(
        told.contains("as `Damping to next [N m s/rad]` (Relative Dämpfung) and `Damping to ground [N m s/rad]` (Absolute Dämpfung) do"),
        "{told}"
    );
    let (_, told) = imported("Station;J [kg m2];k [N m/rad]\nwheel;0,9;900000\ncrank;0,02;300000\nhub;0,01;\n");
    assert!(told.contains("note: the chain begins with `wheel`, its largest inertia"), "{told}");
    let place = tempfile::tempdir().expect("a folder");
    for (chain, words) in [
        (CHAIN.replace("k [N m/rad]", "Steifigkeit zur vorherigen Masse [N m/rad]"), "move the column up by one row"),
        (format!("{CHAIN}Summe;0,93;\n"), "found `Summe`, expected a station"),
        (CHAIN.replace("hub;0,01;300000", "hub;0,01;\nshaft;;300000"), "found no inertia, expected one above zero: a row is a station"),
    ] {
        let told = refused(place.path(), &chain);
        assert!(told.contains(words), "{chain}: {told}");
    }
}
