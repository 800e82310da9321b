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
//

#ifndef CGAL_LICENSE_ARAP_DEFORMATION_H
#define CGAL_LICENSE_ARAP_DEFORMATION_H

#include <CGAL/config.h>
#include <CGAL/license.h>

#ifdef CGAL_ARAP_DEFORMATION_COMMERCIAL_LICENSE

#  if CGAL_ARAP_DEFORMATION_COMMERCIAL_LICENSE < CGAL_RELEASE_DATE

#    if defined(CGAL_LICENSE_WARNING)

       CGAL_pragma_warning("Your commercial license for CGAL does not cover "
                           "this release of the As-Rigid-As-Possible Deformation package.")
#    endif

#    ifdef CGAL_LICENSE_ERROR
#      error "Your commercial license for CGAL does not cover this release \
              of the As-Rigid-As-Possible Deformation package. \
              You get this error, as you defined CGAL_LICENSE_ERROR."
#    endif // CGAL_LICENSE_ERROR

#  endif // CGAL_ARAP_DEFORMATION_COMMERCIAL_LICENSE < CGAL_RELEASE_DATE

#else // no CGAL_ARAP_DEFORMATION_COMMERCIAL_LICENSE

#  if defined(CGAL_LICENSE_WARNING)
     CGAL_pragma_warning("\nThe macro CGAL_ARAP_DEFORMATION_COMMERCIAL_LICENSE is not defined."
                          "\nYou use the CGAL As-Rigid-As-Possible Deformation package under "
                          "the terms of the GPLv3+.")
#  endif // CGAL_LICENSE_WARNING

#  ifdef CGAL_LICENSE_ERROR
#    error "The macro CGAL_ARAP_DEFORMATION_COMMERCIAL_LICENSE is not defined.\
            You use the CGAL As-Rigid-As-Possible Deformation package under the terms of \
            the GPLv3+. You get this error, as you defined CGAL_LICENSE_ERROR."
#  endif // CGAL_LICENSE_ERROR

#endif // no CGAL_ARAP_DEFORMATION_COMMERCIAL_LICENSE

#endif // CGAL_LICENSE_ARAP_DEFORMATION_H
