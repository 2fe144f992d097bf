//! Tools that the program calls by name: `tools.csv` and LinuxCNC's tool table.

use crate::one_error::assert_one_error;
use crate::shop::{Shop, accepted, commands, refused};
use std::process::{Command, Output};

const PROGRAM: &str = "T=\"UGT0201_085\" M6\nM30\n";

const INI: &str = "[EMC]\nMACHINE = mill\n[EMCIO]\nTOOL_TABLE = mill.tbl\n";

const TABLE: &str =
    "T1 P1 D8.5 Z10 ;ugt0201_085 end mill\nT2 P2 D6 ;UGT0201_060\nT7 P7 ;drill 5\nT8 P8 ;drill 8\n";

/// A program beside its list, and a configuration with another list and a tool table.
fn shop(program: &str, list: &str, other_list: &str, table: &str) -> Shop {
    let shop = Shop::new(&[
        ("programs/part.mpf", program.as_bytes()),
        ("programs/tools.csv", list.as_bytes()),
        ("config/mill.ini", INI.as_bytes()),
        ("config/mill.tbl", table.as_bytes()),
    ]);
    if !other_list.is_empty() {
        std::fs::write(shop.path("config/tools.csv"), other_list).expect("a file");
    }
    shop
}

/// As LinuxCNC runs the filter: without options besides the dialect.
fn run(shop: &Shop, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_framepath"))
        .current_dir(shop.path("config"))
        .env("INI_FILE_NAME", shop.path("config/mill.ini"))
        .args(["filter", "--dialect", "sinumerik"])
        .args(arguments)
        .arg(shop.path("programs/part.mpf"))
        .output()
        .expect("the tool runs")
}

fn tool(shop: &Shop, arguments: &[&str]) -> String {
    let output = accepted(&run(shop, arguments));
    let line = commands(&output)
        .into_iter()
        .find(|line| line.starts_with('T'));
    line.expect("a tool").split(' ').next().expect("T").into()
}

#[test]
fn the_nearest_file_counts() {
    let name = "UGT0201_085";
    for (list, other, arguments, number) in [
        (
            "name,number\nUGT0201_085,11\n",
            "UGT0201_085,12\n",
            &[][..],
            "T11",
        ),
        ("OTHER,11\n", "ugt0201_085;12\n", &[], "T12"),
        ("OTHER,11\n", "", &[], "T1"),
        ("UGT0201_085,11\n", "", &["--tool", "ugt0201_085=14"], "T14"),
    ] {
        let shop = shop(PROGRAM, list, other, TABLE);
        assert_eq!(tool(&shop, arguments), number, "{name} {list} {other}");
    }
}

#[test]
fn the_whole_comment_is_a_name_too() {
    let shop = shop("T=\"Drill 8\" M6\nM30\n", "A,3\n", "", TABLE);
    assert_eq!(tool(&shop, &[]), "T8");
}

#[test]
fn unknown_and_ambiguous_names_are_refused() {
    for (program, place, words) in [
        (
            "T=\"UGT0201_086\" M6\nM30\n",
            "part.mpf:1:1",
            "did you mean \"UGT0201_085\", \"UGT0201_060\"?",
        ),
        (
            "T=\"TAP_M6\" M6\nM30\n",
            "part.mpf:1:1",
            "beside the INI file, as the comment of its line of LinuxCNC's tool table",
        ),
        (
            "T=\"drill\" M6\nM30\n",
            "part.mpf:1:1",
            "several tools are called \"drill\"",
        ),
    ] {
        let shop = shop(program, "A,3\n", "", TABLE);
        let shown = refused(&run(&shop, &[]));
        assert_one_error(&shown, program, place, words);
    }
}

#[test]
fn what_is_wrong_in_a_file_is_shown_there() {
    for (list, other, table, place, words) in [
        (
            "A,3\nB;4\n",
            "",
            TABLE,
            "programs/tools.csv:2:1",
            "a name and a number",
        ),
        (
            "A,3\n",
            "name,number\nB, x\n",
            TABLE,
            "config/tools.csv:2:4",
            "`x` is not",
        ),
        (
            "A,3\n",
            "",
            "T1 P1\nT2 P2 K7 ;x\n",
            "config/mill.tbl:2:7",
            "`K7` is no word",
        ),
    ] {
        let shop = shop(PROGRAM, list, other, table);
        assert_one_error(&refused(&run(&shop, &[])), list, place, words);
        // A program that names no tool has nothing to do with them.
        std::fs::write(shop.path("programs/part.mpf"), "T3 M6\nM30\n").expect("a file");
        assert_eq!(tool(&shop, &[]), "T3");
    }
}

#[test]
fn without_lists_and_ini_the_error_says_what_to_do() {
    let shop = Shop::new(&[("part.mpf", PROGRAM.as_bytes())]);
    let output = Command::new(env!("CARGO_BIN_EXE_framepath"))
        .current_dir(shop.path("."))
        .env_remove("INI_FILE_NAME")
        .args(["filter", "--dialect", "sinumerik", "part.mpf"])
        .output()
        .expect("the tool runs");
    let shown = refused(&output);
    assert_one_error(&shown, PROGRAM, "part.mpf:1:1", "no INI file is known");
}

/// LinuxCNC's G49 leaves the radius of the tool alone.
#[test]
fn without_an_edge_there_is_no_radius() {
    let program = "T5 M6\nD0\nG0 X0 Y0\nG1 G41 X10 Y10 F100\nX20\nG40 X40\nD1\nG41 X50\nX55\nG40 X60\nD0\n\
                   T6 M6\nG41 X50 Y10\nG40 X60\nM30\n";
    let shop = Shop::new(&[("part.mpf", program.as_bytes())]);
    let lines = commands(&accepted(&shop.run_in("sinumerik", "part.mpf", &[])));
    let begun: Vec<_> = lines
        .iter()
        .filter(|line| line.starts_with("G41"))
        .collect();
    assert_eq!(
        begun,
        ["G41.1 D0 G1 X10 Y10 F100", "G41 G1 X50", "G41 G1 X50 Y10"]
    );
}

/// T turns the turret of most lathes: what cuts with the tool of before is refused.
#[test]
fn a_lathe_cuts_with_no_tool_that_was_not_changed_to() {
    let run = |program: &str, ini: &str| {
        let head = "G18 G54 DIAMON\nT1 D1 M6\nS500 M4 F100\nG0 X50 Z5\nG1 Z-20\nG0 X99 Z99\n";
        let program = format!("{head}{program}\nM30\n");
        let shop = Shop::new(&[
            ("part.mpf", program.as_bytes()),
            ("shop.ini", ini.as_bytes()),
        ]);
        shop.run("part.mpf", &["--ini", "shop.ini"])
    };
    let (lathe, mill) = (
        "[TRAJ]\nCOORDINATES = X Z\n",
        "[TRAJ]\nCOORDINATES = X Y Z\n",
    );
    for (program, place) in [
        ("T2\nG0 X48 Z5\nG1 Z-20\nZ-30", "part.mpf:9:1"),
        ("T2 D1\nG0 X48 Z5\nG1 Z-20", "part.mpf:9:1"),
        ("T2\nG1 Z-20 F50", "part.mpf:8:1"),
        ("T2\nG1 SUPA Z-20", "part.mpf:8:1"),
        ("T2\nG33 Z-20 K1", "part.mpf:8:1"),
        ("G1\nT2 Z-20", "part.mpf:8:1"),
    ] {
        let shown = refused(&run(program, lathe));
        assert!(
            shown.contains(place) && shown.contains("T2 M6"),
            "{program}\n{shown}"
        );
        assert_eq!(shown.matches("error: ").count(), 2, "and how many: {shown}");
        accepted(&run(program, mill));
    }
    for program in [
        "T2\nG0 X90\nM6\nG1 Z-20",
        "T2 M6\nG1 Z-20",
        "T1\nG1 Z-20",
        "T2\nG0 X90\nT0",
        "M6 T2\nG1 Z-20",
    ] {
        accepted(&run(program, lathe));
    }
}

/// Its length is switched on behind the way over the part: where X and Y are stays known where no tool has an offset in
/// them. What is wrong in the lists is no matter of a program that names no tool.
#[test]
fn a_length_moves_the_axes_of_the_table() {
    let program = "T1 M6\nF100\nG0 X10 Y20\nD1 Z15\nG1 X20 RND=2\nY30\nM30\n";
    for (list, table, known) in [
        ("A,3\n", TABLE, true),
        ("A,3\n", "T1 P1 Z10 X0 Y+0.0\n", true),
        ("A,3\n", "T1 P1 Z10\nT2 P2 X1\n", false),
        ("A,x\n", TABLE, false),
    ] {
        let output = run(&shop(program, list, "", table), &[]);
        match known {
            true => drop(accepted(&output)),
            false => assert!(refused(&output).contains("begins or ends where is not known")),
        }
    }
}

#[test]
fn a_database_of_tools_is_no_table() {
    let shop = shop(
        "T1 M6\nG0 X0 Y0 Z9\nSLOT1(9,0,1,-3,,2,20,6,0,0,10,0,90,300,800,2,3,0)\nM30\n",
        "A,3\n",
        "",
        TABLE,
    );
    std::fs::write(
        shop.path("config/mill.ini"),
        format!("{INI}DB_PROGRAM = ./tools.py\n"),
    )
    .expect("a file");
    let errors = refused(&run(&shop, &[]));
    assert!(
        errors.contains("mill.ini has its tools from [EMCIO]DB_PROGRAM"),
        "{errors}"
    );
}
