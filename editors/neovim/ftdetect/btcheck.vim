" SPDX-License-Identifier: MIT
autocmd BufNewFile,BufRead *.btf setfiletype btf
autocmd BufNewFile,BufRead *.leaves set filetype=btcheck-leaves
autocmd BufNewFile,BufRead *.ltl,*.btp set filetype=btcheck-rules
autocmd BufNewFile,BufRead *.btproj setfiletype xml
