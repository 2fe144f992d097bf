//! Files with nothing in them: LinuxCNC would refuse a program without an end.

use crate::shop::{Shop, accepted, refused};

#[test]
fn a_program_without_a_block_is_refused() {
    for dialect in ["sinumerik", "fagor", "mefi", "isg", "fanuc"] {
        for content in ["", "\n\n"] {
            let shop = Shop::new(&[("part.nc", content.as_bytes())]);
            for backend in ["auto", "kinematics", "program"] {
                let error = refused(&shop.run_in(dialect, "part.nc", &["--backend", backend]));
                assert!(
                    error.contains("there is no block in this program"),
                    "{dialect}: {error}"
                );
            }
        }
    }
    let shop = Shop::new(&[("part.nc", b"O1\n".as_slice())]);
    refused(&shop.run_in("fanuc", "part.nc", &[]));
    let shop = Shop::new(&[("part.nc", b"M30\n".as_slice())]);
    let output = accepted(&shop.run_in("fanuc", "part.nc", &[]));
    assert!(output.contains("\nM30 "), "{output}");
}
