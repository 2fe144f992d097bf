//! Joints as they are told another process, which makes the same of them.

use super::module::{ModuleJoints, ModuleSettings};
use super::table::{Table, TableMachine};
use super::{Begin, Behind, LimitedJoints};
use crate::path::Position;
use serde::{Deserialize, Serialize};

/// What is told.
#[derive(Serialize, Deserialize)]
pub(super) struct Told {
    behind: ToldBehind,
    limits: [Position; 3],
    tool_tilt_axis: Option<usize>,
    begin: Begin,
}

#[derive(Serialize, Deserialize)]
enum ToldBehind {
    Table(Table),
    Module(Box<ModuleSettings>),
}

impl TryFrom<Told> for LimitedJoints {
    type Error = String;

    fn try_from(told: Told) -> Result<LimitedJoints, String> {
        let behind = match told.behind {
            ToldBehind::Table(table) => {
                let machine = table.machine().map_err(|why| why.to_string())?;
                Behind::Table(table, TableMachine::new(machine))
            }
            ToldBehind::Module(settings) => {
                let joints = ModuleJoints::new(*settings).map_err(|why| why.to_string())?;
                Behind::Module(Box::new(joints))
            }
        };
        Ok(LimitedJoints {
            behind,
            limits: told.limits,
            tool_tilt_axis: told.tool_tilt_axis,
            begin: told.begin,
        })
    }
}

impl From<LimitedJoints> for Told {
    fn from(joints: LimitedJoints) -> Told {
        Told {
            behind: match joints.behind {
                Behind::Table(table, _) => ToldBehind::Table(table),
                Behind::Module(joints) => ToldBehind::Module(Box::new(joints.into_settings())),
            },
            limits: joints.limits,
            tool_tilt_axis: joints.tool_tilt_axis,
            begin: joints.begin,
        }
    }
}
