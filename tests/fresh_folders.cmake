# SPDX-License-Identifier: BSD-3-Clause
# Copyright (c) 2026 The Anneal6D authors
#
# A script (cmake -P): begins the tests of the build folder `build` without what earlier ones left.
# Prepared models are kept neither in the user's home nor for later versions of the code. With
# `views`, a folder of another build's, those that its tests made are taken over if there are any.
file(REMOVE_RECURSE ${build}/tests/cache ${build}/tests/results)
if(views AND EXISTS ${views})
  file(COPY ${views} DESTINATION ${build}/tests/cache)
endif()
