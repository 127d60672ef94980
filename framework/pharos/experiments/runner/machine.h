#pragma once

#include <string>

namespace pharos {

/// Threads that parallel work may use here.
int thread_count();

/// The processor's name as Linux tells it; empty elsewhere.
std::string processor_name();

}  // namespace pharos
