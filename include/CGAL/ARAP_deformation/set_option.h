// Copyright (c) 2026  The ARAP_deformation authors.
// All rights reserved.
//
// This file is part of CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later OR LicenseRef-Commercial
//
// Author(s)     : The ARAP_deformation authors

#ifndef CGAL_ARAP_DEFORMATION_SET_OPTION_H
#define CGAL_ARAP_DEFORMATION_SET_OPTION_H

#include <CGAL/ARAP_deformation/internal/config.h>
#include <CGAL/license/ARAP_deformation.h>

#include <CGAL/ARAP_deformation/Options.h>
#include <CGAL/ARAP_deformation/Status.h>
#include <CGAL/ARAP_deformation/internal/session/option_text.h>

#include <map>
#include <string>

namespace CGAL {
namespace ARAP {

/// \ingroup PkgARAPDeformationOptions
/// \brief sets options that are given by their names and their values as text, for programs that
/// read options from a command line, a file or another language.
///
/// The names are those of the members of `Options` and of the enumerators; cells are `spokes`,
/// `spokes_and_rims`, `elements` or `k_ring:K`. Returns `Status::invalid_option`, with a message
/// that has the name and tells what is possible, and changes nothing, if a name is unknown, a value
/// is not one of its option, or the options are not valid together.
///
/// \param options the options
/// \param values a range of pairs of a name and a value, such as a
///        `std::map<std::string, std::string>`
template <typename NamedValueRange>
Outcome set_options(Options& options, const NamedValueRange& values)
{
  Options changed = options;
  for(const auto& [name, value] : values)
    if(Outcome outcome =
         internal::with_option(changed, name, internal::Read_option{name, value}); !outcome)
      return outcome;
  Outcome checked = changed.check();
  if(checked)
    options = changed;
  return checked;
}

/// \ingroup PkgARAPDeformationOptions
/// \brief sets one option, as `set_options()` does several.
inline Outcome set_option(Options& options, const std::string& name, const std::string& value)
{
  return set_options(options, std::map<std::string, std::string>{{name, value}});
}

/// \ingroup PkgARAPDeformationOptions
/// \brief returns the value of an option as text that `set_option()` reads, numbers with all their
/// digits; an empty text if there is no option of that name.
inline std::string option_value(const Options& options, const std::string& name)
{
  std::string text;
  internal::with_option(options, name, internal::Write_option{text});
  return text;
}

} // namespace ARAP
} // namespace CGAL

#endif // CGAL_ARAP_DEFORMATION_SET_OPTION_H
