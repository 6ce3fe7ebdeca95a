#pragma once

#include "tests/bench/Bench.h"
