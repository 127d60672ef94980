#pragma once

#include <string>

namespace pharos {

/// Returns the number of threads that parallel work may use.
int thread_count();

/// Returns the processor's name as Linux reports it; empty on other systems.
std::string processor_name();

}  // namespace pharos
