# Fig. 5 of the paper
# Time of all detectors against NM, in the plane, nk = 27.
# To draw it again, as SVG and as PNG: gnuplot fig05_fair.gp
# bqsa-bench 0.1.0, commit 57ebae6085, GNU 12.2.0, AMD EPYC, measured 2026-11-26T02:39:54Z (quick)
# flags -O3 -DNDEBUG; governor unknown; others kept 0.00 of 2 cores busy; Debian GNU/Linux 12 (bookworm), kernel 6.18.44-fc-v657

name = "fig05_fair"
format = exists("format") ? format : "svg"
if (format eq "svg") {
  set terminal svg size 1300,800 font "DejaVu Sans,15" background "white"
} else {
  set terminal pngcairo size 1300,800 font "DejaVu Sans,15"
}
set output name . "." . format
set encoding utf8
set datafile separator ","
set datafile columnheaders
set border 3 linecolor "#404040"
set tics nomirror textcolor "#202020"
set grid linecolor "#d8d8d8" linewidth 1 dashtype solid
set style line 1 linecolor "#000000" linewidth 2 dashtype solid      pointtype 7
set style line 2 linecolor "#46149c" linewidth 2 dashtype (9,4)      pointtype 5
set style line 3 linecolor "#93267a" linewidth 2 dashtype (12,3,2,3) pointtype 9
set style line 4 linecolor "#c33b4f" linewidth 2 dashtype solid      pointtype 4
set style line 5 linecolor "#e2662e" linewidth 2 dashtype (5,3)      pointtype 13
set style line 6 linecolor "#ee9418" linewidth 2 dashtype (2,3)      pointtype 8
set style line 7 linecolor "#d9b13b" linewidth 2 dashtype solid      pointtype 6
set style line 8 linecolor "#9a9a9a" linewidth 2 dashtype (9,3,2,3,2,3) pointtype 12

set multiplot
set label 99 "bqsa-bench 0.1.0, commit 57ebae6085, GNU 12.2.0, AMD EPYC, measured 2026-11-26T02:39:54Z (quick)" at screen 0.012,0.016 left font ",9" textcolor "#505050"
set logscale xy
set format x "10^{%L}"
set format y "10^{%L}"
set logscale x2
set x2range [1:10000]
set x2tics ("99.1" 1, "98.2" 2, "96.2" 5, "94.6" 10, "88" 20, "70.2" 50, "48.9" 100, "18.3" 200, "1.47" 500, "1.39" 1000, "1.38" 2000, "1.31" 5000, "1.31" 10000) font ",10" offset 0,-0.4
set x2label "hits that test points miss [%], links of any place and direction" font ",11" offset 0,0.1
set xlabel "NM, test points of a link times those of an obstacle"
set ylabel "time of a pass over all nk pairs [µs]"
set key outside right center reverse Left font ",12" samplen 4 spacing 1.25
set tmargin 5.2; set bmargin 4.5; set pointsize 0.9
set title "in the plane, nk = 27"
set xrange [1:10000]
plot name . ".csv" using "NM":"test_points [us]":"test_points lower [us]":"test_points upper [us]" with yerrorbars linecolor "#5a1fa6" linewidth 1.2 dashtype solid pointtype 0 notitle, \
  name . ".csv" using "NM":"test_points [us]" with linespoints linecolor "#5a1fa6" linewidth 1.8 dashtype solid pointtype 9 title "test points", \
  name . ".csv" using "NM":"fcl_collide_indep [us]":"fcl_collide_indep lower [us]":"fcl_collide_indep upper [us]" with yerrorbars linecolor "#e2662e" linewidth 1.2 dashtype solid pointtype 0 notitle, \
  name . ".csv" using "NM":"fcl_collide_indep [us]" with linespoints linecolor "#e2662e" linewidth 1.8 dashtype (9,4) pointtype 4 title "FCL collide, own GJK", \
  name . ".csv" using "NM":"fcl_distance_indep [us]":"fcl_distance_indep lower [us]":"fcl_distance_indep upper [us]" with yerrorbars linecolor "#e3a21a" linewidth 1.2 dashtype solid pointtype 0 notitle, \
  name . ".csv" using "NM":"fcl_distance_indep [us]" with linespoints linecolor "#e3a21a" linewidth 1.8 dashtype (9,4) pointtype 10 title "FCL distance, own GJK", \
  name . ".csv" using "NM":"fcl_distance_libccd [us]":"fcl_distance_libccd lower [us]":"fcl_distance_libccd upper [us]" with yerrorbars linecolor "#e3a21a" linewidth 1.2 dashtype solid pointtype 0 notitle, \
  name . ".csv" using "NM":"fcl_distance_libccd [us]" with linespoints linecolor "#e3a21a" linewidth 1.8 dashtype solid pointtype 11 title "FCL distance, libccd", \
  name . ".csv" using "NM":"fcl_distance_broadphase [us]":"fcl_distance_broadphase lower [us]":"fcl_distance_broadphase upper [us]" with yerrorbars linecolor "#e3a21a" linewidth 1.2 dashtype solid pointtype 0 notitle, \
  name . ".csv" using "NM":"fcl_distance_broadphase [us]" with linespoints linecolor "#e3a21a" linewidth 1.8 dashtype (2,3) pointtype 2 title "FCL distance, broadphase", \
  name . ".csv" using "NM":"test_points_inside [us]":"test_points_inside lower [us]":"test_points_inside upper [us]" with yerrorbars linecolor "#5a1fa6" linewidth 1.2 dashtype solid pointtype 0 notitle, \
  name . ".csv" using "NM":"test_points_inside [us]" with linespoints linecolor "#5a1fa6" linewidth 1.8 dashtype (2,3) pointtype 11 title "test points, vectorised, inside test", \
  name . ".csv" using "NM":"test_points_vectorized [us]":"test_points_vectorized lower [us]":"test_points_vectorized upper [us]" with yerrorbars linecolor "#5a1fa6" linewidth 1.2 dashtype solid pointtype 0 notitle, \
  name . ".csv" using "NM":"test_points_vectorized [us]" with linespoints linecolor "#5a1fa6" linewidth 1.8 dashtype (9,4) pointtype 8 title "test points, vectorised", \
  name . ".csv" using "NM":"bullet_gjk [us]":"bullet_gjk lower [us]":"bullet_gjk upper [us]" with yerrorbars linecolor "#b4b4b4" linewidth 1.2 dashtype solid pointtype 0 notitle, \
  name . ".csv" using "NM":"bullet_gjk [us]" with linespoints linecolor "#b4b4b4" linewidth 1.8 dashtype (2,3) pointtype 1 title "Bullet GJK, early-out", \
  name . ".csv" using "NM":"fcl_collide_libccd [us]":"fcl_collide_libccd lower [us]":"fcl_collide_libccd upper [us]" with yerrorbars linecolor "#e2662e" linewidth 1.2 dashtype solid pointtype 0 notitle, \
  name . ".csv" using "NM":"fcl_collide_libccd [us]" with linespoints linecolor "#e2662e" linewidth 1.8 dashtype solid pointtype 5 title "FCL collide, libccd", \
  name . ".csv" using "NM":"fcl_collide_broadphase [us]":"fcl_collide_broadphase lower [us]":"fcl_collide_broadphase upper [us]" with yerrorbars linecolor "#e2662e" linewidth 1.2 dashtype solid pointtype 0 notitle, \
  name . ".csv" using "NM":"fcl_collide_broadphase [us]" with linespoints linecolor "#e2662e" linewidth 1.8 dashtype (2,3) pointtype 12 title "FCL collide, broadphase", \
  name . ".csv" using "NM":"exact_distance [us]":"exact_distance lower [us]":"exact_distance upper [us]" with yerrorbars linecolor "#b3264d" linewidth 1.2 dashtype solid pointtype 0 notitle, \
  name . ".csv" using "NM":"exact_distance [us]" with linespoints linecolor "#b3264d" linewidth 1.8 dashtype solid pointtype 13 title "exact distance", \
  name . ".csv" using "NM":"ccd_gjk [us]":"ccd_gjk lower [us]":"ccd_gjk upper [us]" with yerrorbars linecolor "#b4b4b4" linewidth 1.2 dashtype solid pointtype 0 notitle, \
  name . ".csv" using "NM":"ccd_gjk [us]" with linespoints linecolor "#b4b4b4" linewidth 1.8 dashtype solid pointtype 6 title "libccd GJK", \
  name . ".csv" using "NM":"ccd_mpr [us]":"ccd_mpr lower [us]":"ccd_mpr upper [us]" with yerrorbars linecolor "#b4b4b4" linewidth 1.2 dashtype solid pointtype 0 notitle, \
  name . ".csv" using "NM":"ccd_mpr [us]" with linespoints linecolor "#b4b4b4" linewidth 1.8 dashtype (9,4) pointtype 14 title "libccd MPR", \
  name . ".csv" using "NM":"exact_distance_batched [us]":"exact_distance_batched lower [us]":"exact_distance_batched upper [us]" with yerrorbars linecolor "#b3264d" linewidth 1.2 dashtype solid pointtype 0 notitle, \
  name . ".csv" using "NM":"exact_distance_batched [us]" with linespoints linecolor "#b3264d" linewidth 1.8 dashtype (9,4) pointtype 12 title "exact distance, batched", \
  name . ".csv" using "NM":"bqsa_paper_shared [us]":"bqsa_paper_shared lower [us]":"bqsa_paper_shared upper [us]" with yerrorbars linecolor "#000000" linewidth 1.2 dashtype solid pointtype 0 notitle, \
  name . ".csv" using "NM":"bqsa_paper_shared [us]" with linespoints linecolor "#000000" linewidth 1.8 dashtype (9,3,2,3) pointtype 6 title "BQSA, paper's form, shared products", \
  name . ".csv" using "NM":"bqsa_paper [us]":"bqsa_paper lower [us]":"bqsa_paper upper [us]" with yerrorbars linecolor "#000000" linewidth 1.2 dashtype solid pointtype 0 notitle, \
  name . ".csv" using "NM":"bqsa_paper [us]" with linespoints linecolor "#000000" linewidth 1.8 dashtype solid pointtype 7 title "BQSA, paper's form", \
  name . ".csv" using "NM":"bqsa_parameter [us]":"bqsa_parameter lower [us]":"bqsa_parameter upper [us]" with yerrorbars linecolor "#000000" linewidth 1.2 dashtype solid pointtype 0 notitle, \
  name . ".csv" using "NM":"bqsa_parameter [us]" with linespoints linecolor "#000000" linewidth 1.8 dashtype (2,3) pointtype 4 title "BQSA, parameter form", \
  name . ".csv" using "NM":"bqsa_space [us]":"bqsa_space lower [us]":"bqsa_space upper [us]" with yerrorbars linecolor "#000000" linewidth 1.2 dashtype solid pointtype 0 notitle, \
  name . ".csv" using "NM":"bqsa_space [us]" with linespoints linecolor "#000000" linewidth 1.8 dashtype (9,3,2,3) pointtype 12 title "BQSA in 3-D", \
  name . ".csv" using "NM":"bqsa [us]":"bqsa lower [us]":"bqsa upper [us]" with yerrorbars linecolor "#000000" linewidth 1.2 dashtype solid pointtype 0 notitle, \
  name . ".csv" using "NM":"bqsa [us]" with linespoints linecolor "#000000" linewidth 1.8 dashtype (9,4) pointtype 5 title "BQSA", \
  name . ".csv" using "NM":"bqsa_batch [us]":"bqsa_batch lower [us]":"bqsa_batch upper [us]" with yerrorbars linecolor "#000000" linewidth 1.2 dashtype solid pointtype 0 notitle, \
  name . ".csv" using "NM":"bqsa_batch [us]" with linespoints linecolor "#000000" linewidth 1.8 dashtype (2,3) pointtype 8 title "BQSA, batched", \
  name . ".csv" using "NM":"bqsa_batch_float [us]":"bqsa_batch_float lower [us]":"bqsa_batch_float upper [us]" with yerrorbars linecolor "#000000" linewidth 1.2 dashtype solid pointtype 0 notitle, \
  name . ".csv" using "NM":"bqsa_batch_float [us]" with linespoints linecolor "#000000" linewidth 1.8 dashtype (2,3) pointtype 10 title "BQSA, batched, float"

unset multiplot
unset output
if (format eq "svg") {
  format = "png"
  reset
  load name . ".gp"
}
