#pragma once

#define HEXWRIGHT_VERSION "0.1.0"
