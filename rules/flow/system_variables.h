// Which table of the control a system variable belongs to, also where its number is computed.
#pragma once

#include "rules/flow/flow_view.h"

namespace feedhold::rules {

/// Plain for local, common and unknown variables.
VariableRole roleOf(const FileContext &context, std::uint32_t variable);

/// Length, radius, geometry or wear of a tool.
bool isToolOffset(const FileContext &context, std::uint32_t variable);
/// A tool offset or a work offset.
bool isOffset(const FileContext &context, std::uint32_t variable);
/// An end point, or a position of the axes now.
bool isPosition(VariableRole role);

/// The number that an expression names: of `#2001` itself; of `#[2000+#3]` the first one of the table, 2001.
std::optional<std::uint32_t> tableNumber(const FileContext &context, ExpressionId variable);

} // namespace feedhold::rules
