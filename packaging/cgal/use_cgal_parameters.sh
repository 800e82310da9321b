#!/usr/bin/env bash
# Lets the package use the named parameters that tree.patch adds to CGAL: parameters.h goes, and what
# has the rest of a sequence as its second argument, as in a(x, b(y)), becomes a(x).b(y).
# usage: packaging/cgal/use_cgal_parameters.sh PACKAGE   the folder ARAP_deformation in CGAL's tree
set -euo pipefail
names=$(sed -n 's/^+CGAL_add_named_parameter(\w*, \(\w*\), .*/\1/p' "$(dirname "$0")/tree.patch" | paste -sd '|')
cd "$1"
rm include/CGAL/ARAP_deformation/parameters.h
grep -rlE "ARAP_deformation/parameters\.h|::($names)\(" include test examples demo doc | xargs perl -0pi -e '
  my $nested = "\\((?&any)\\)|\\[(?&any)\\]|\\{(?&any)\\}";
  my $define = "(?(DEFINE)(?<any>(?:[^][(){}]|$nested)*)(?<one>(?:[^][(){},]|$nested)+))";
  my $scope = "(?:\\w+::)+"; # CGAL::parameters, or another name for it
  my $name = "(?:$scope|\\.)(?:'"$names"')";
  s/#include <CGAL\/ARAP_deformation\/parameters\.h>\n//g;
  1 while s/$define(?<name>$name)\((?<value>(?&one)),\s*$scope(?<rest>(?&any))\)/$+{name}($+{value}).$+{rest}/;
  s/parameters::('"$names"')\(([\w.]+), np\)/np.$1($2)/g;'
