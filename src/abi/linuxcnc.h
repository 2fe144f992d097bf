/* The headers of LinuxCNC that the two modules speak with. motion.h has to come before tp.h. */
#include "motion.h"
#include "tp.h"
#include "kinematics.h"
