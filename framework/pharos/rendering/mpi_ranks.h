#pragma once

#include <pharos/rendering/ranks.h>

/// The entry point of libpharos_mpi, a library of its own, so that the program starts where there
/// is no MPI. It joins the other processes that mpirun or srun has started. The caller owns the
/// object and destroys it before the program ends.
extern "C" pharos::Ranks* pharos_mpi_ranks();
