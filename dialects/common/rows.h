// How a line of a .def file becomes a row.  To be included before each .def, which takes its macro away again; so no
// `#pragma once`.
#ifndef CODE
#define CODE(tenths, group, role, action, meaning) Code{tenths, group, CodeRole::role, CodeAction::action, meaning},
#endif
#ifndef VARIABLE
#define VARIABLE(first, last, kind, access, start, option, role, name, meaning)                                        \
  VariableRange{first,                                                                                                 \
                last,                                                                                                  \
                VariableKind::kind,                                                                                    \
                VariableAccess::access,                                                                                \
                VariableStart::start,                                                                                  \
                VariableOption::option,                                                                                \
                VariableRole::role,                                                                                    \
                name,                                                                                                  \
                meaning},
#endif
#ifndef ALARM_NUMBER
#define ALARM_NUMBER(kind, number) AlarmNumber{AlarmKind::kind, number},
#endif
#ifndef PREDEFINED
#define PREDEFINED(name, source, detail, range, meaning)                                                               \
  PredefinedName{VariableRange{0, 0, VariableKind::System, VariableAccess::ReadOnly, VariableStart::Unknown,           \
                               VariableOption::Always, VariableRole::Predefined, name, meaning},                       \
                 NameSource::source, detail, NameRange::range},
#endif
