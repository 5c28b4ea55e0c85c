# Time a pair against the share of hits that are missed, all detectors in the plane: test points are labelled with NM.
# To draw it again, as SVG and as PNG: gnuplot time_against_miss_rate.gp
# bqsa-bench 0.1.0, commit 57ebae6085, GNU 12.2.0, AMD EPYC, measured 2026-11-26T02:39:54Z (quick)
# flags -O3 -DNDEBUG; governor unknown; others kept 0.00 of 2 cores busy; Debian GNU/Linux 12 (bookworm), kernel 6.18.44-fc-v657

name = "time_against_miss_rate"
format = exists("format") ? format : "svg"
if (format eq "svg") {
  set terminal svg size 1300,900 font "DejaVu Sans,15" background "white"
} else {
  set terminal pngcairo size 1300,900 font "DejaVu Sans,15"
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
set xrange [8.33333e-07:1.6]
set xtics ("0" 1e-05, "10^{-4}" 1e-4, "10^{-3}" 1e-3, "10^{-2}" 1e-2, "10^{-1}" 1e-1, "1" 1)
set arrow from 4e-05,graph 0 to 4e-05,graph 1 nohead linecolor "#707070" dashtype (2,4)
set xlabel "share of hits that are missed"
set key at screen 0.72,0.9 left top reverse Left font ",12" samplen 2.5 spacing 1.3
set key title "numbers at curves: NM" left

set lmargin at screen 0.0700; set rmargin at screen 0.3750; set bmargin at screen 0.1100; set tmargin at screen 0.9200
set title "links of any place and direction"
set ylabel "time a pair [ns]"
plot name . "_anywhere.csv" using "shown at":(stringcolumn("detector") eq "test_points" ? column("time a pair [ns]") : NaN) with linespoints linecolor "#5a1fa6" linewidth 1.8 dashtype solid pointtype 9 title "test points", \
  "" using "shown at":(stringcolumn("detector") eq "test_points" ? column("time a pair [ns]") : NaN):(column("NM") < 10 ? "" : sprintf("%g", column("NM"))) with labels font ",10" offset 2.3,0.3 notitle, \
  name . "_anywhere.csv" using "shown at":(stringcolumn("detector") eq "fcl_collide_indep" ? column("time a pair [ns]") : NaN) with linespoints linecolor "#e2662e" linewidth 1.8 dashtype (9,4) pointtype 4 title "FCL collide, own GJK", \
  name . "_anywhere.csv" using "shown at":(stringcolumn("detector") eq "fcl_distance_indep" ? column("time a pair [ns]") : NaN) with linespoints linecolor "#e3a21a" linewidth 1.8 dashtype (9,4) pointtype 10 title "FCL distance, own GJK", \
  name . "_anywhere.csv" using "shown at":(stringcolumn("detector") eq "fcl_distance_libccd" ? column("time a pair [ns]") : NaN) with linespoints linecolor "#e3a21a" linewidth 1.8 dashtype solid pointtype 11 title "FCL distance, libccd", \
  name . "_anywhere.csv" using "shown at":(stringcolumn("detector") eq "fcl_distance_broadphase" ? column("time a pair [ns]") : NaN) with linespoints linecolor "#e3a21a" linewidth 1.8 dashtype (2,3) pointtype 2 title "FCL distance, broadphase", \
  name . "_anywhere.csv" using "shown at":(stringcolumn("detector") eq "test_points_inside" ? column("time a pair [ns]") : NaN) with linespoints linecolor "#5a1fa6" linewidth 1.8 dashtype (2,3) pointtype 11 title "test points, vectorised, inside test", \
  "" using "shown at":(stringcolumn("detector") eq "test_points_inside" ? column("time a pair [ns]") : NaN):(column("NM") < 10 ? "" : sprintf("%g", column("NM"))) with labels font ",10" offset -2.3,-0.3 notitle, \
  name . "_anywhere.csv" using "shown at":(stringcolumn("detector") eq "test_points_vectorized" ? column("time a pair [ns]") : NaN) with linespoints linecolor "#5a1fa6" linewidth 1.8 dashtype (9,4) pointtype 8 title "test points, vectorised", \
  name . "_anywhere.csv" using "shown at":(stringcolumn("detector") eq "bullet_gjk" ? column("time a pair [ns]") : NaN) with linespoints linecolor "#b4b4b4" linewidth 1.8 dashtype (2,3) pointtype 1 title "Bullet GJK, early-out", \
  name . "_anywhere.csv" using "shown at":(stringcolumn("detector") eq "fcl_collide_libccd" ? column("time a pair [ns]") : NaN) with linespoints linecolor "#e2662e" linewidth 1.8 dashtype solid pointtype 5 title "FCL collide, libccd", \
  name . "_anywhere.csv" using "shown at":(stringcolumn("detector") eq "fcl_collide_broadphase" ? column("time a pair [ns]") : NaN) with linespoints linecolor "#e2662e" linewidth 1.8 dashtype (2,3) pointtype 12 title "FCL collide, broadphase", \
  name . "_anywhere.csv" using "shown at":(stringcolumn("detector") eq "exact_distance" ? column("time a pair [ns]") : NaN) with linespoints linecolor "#b3264d" linewidth 1.8 dashtype solid pointtype 13 title "exact distance", \
  name . "_anywhere.csv" using "shown at":(stringcolumn("detector") eq "ccd_gjk" ? column("time a pair [ns]") : NaN) with linespoints linecolor "#b4b4b4" linewidth 1.8 dashtype solid pointtype 6 title "libccd GJK", \
  name . "_anywhere.csv" using "shown at":(stringcolumn("detector") eq "ccd_mpr" ? column("time a pair [ns]") : NaN) with linespoints linecolor "#b4b4b4" linewidth 1.8 dashtype (9,4) pointtype 14 title "libccd MPR", \
  name . "_anywhere.csv" using "shown at":(stringcolumn("detector") eq "exact_distance_batched" ? column("time a pair [ns]") : NaN) with linespoints linecolor "#b3264d" linewidth 1.8 dashtype (9,4) pointtype 12 title "exact distance, batched", \
  name . "_anywhere.csv" using "shown at":(stringcolumn("detector") eq "bqsa_paper_shared" ? column("time a pair [ns]") : NaN) with linespoints linecolor "#000000" linewidth 1.8 dashtype (9,3,2,3) pointtype 6 title "BQSA, paper's form, shared products", \
  name . "_anywhere.csv" using "shown at":(stringcolumn("detector") eq "bqsa_paper" ? column("time a pair [ns]") : NaN) with linespoints linecolor "#000000" linewidth 1.8 dashtype solid pointtype 7 title "BQSA, paper's form", \
  name . "_anywhere.csv" using "shown at":(stringcolumn("detector") eq "bqsa_parameter" ? column("time a pair [ns]") : NaN) with linespoints linecolor "#000000" linewidth 1.8 dashtype (2,3) pointtype 4 title "BQSA, parameter form", \
  name . "_anywhere.csv" using "shown at":(stringcolumn("detector") eq "bqsa_space" ? column("time a pair [ns]") : NaN) with linespoints linecolor "#000000" linewidth 1.8 dashtype (9,3,2,3) pointtype 12 title "BQSA in 3-D", \
  name . "_anywhere.csv" using "shown at":(stringcolumn("detector") eq "bqsa" ? column("time a pair [ns]") : NaN) with linespoints linecolor "#000000" linewidth 1.8 dashtype (9,4) pointtype 5 title "BQSA", \
  name . "_anywhere.csv" using "shown at":(stringcolumn("detector") eq "bqsa_batch" ? column("time a pair [ns]") : NaN) with linespoints linecolor "#000000" linewidth 1.8 dashtype (2,3) pointtype 8 title "BQSA, batched", \
  name . "_anywhere.csv" using "shown at":(stringcolumn("detector") eq "bqsa_batch_float" ? column("time a pair [ns]") : NaN) with linespoints linecolor "#000000" linewidth 1.8 dashtype (2,3) pointtype 10 title "BQSA, batched, float"

set lmargin at screen 0.4050; set rmargin at screen 0.7100; set bmargin at screen 0.1100; set tmargin at screen 0.9200
set title "links at the first contact"
unset ylabel
set format y ""
unset label
plot name . "_first_contact.csv" using "shown at":(stringcolumn("detector") eq "test_points" ? column("time a pair [ns]") : NaN) with linespoints linecolor "#5a1fa6" linewidth 1.8 dashtype solid pointtype 9 notitle, \
  "" using "shown at":(stringcolumn("detector") eq "test_points" ? column("time a pair [ns]") : NaN):(column("NM") < 10 ? "" : sprintf("%g", column("NM"))) with labels font ",10" offset 2.3,0.3 notitle, \
  name . "_first_contact.csv" using "shown at":(stringcolumn("detector") eq "fcl_collide_indep" ? column("time a pair [ns]") : NaN) with linespoints linecolor "#e2662e" linewidth 1.8 dashtype (9,4) pointtype 4 notitle, \
  name . "_first_contact.csv" using "shown at":(stringcolumn("detector") eq "fcl_distance_indep" ? column("time a pair [ns]") : NaN) with linespoints linecolor "#e3a21a" linewidth 1.8 dashtype (9,4) pointtype 10 notitle, \
  name . "_first_contact.csv" using "shown at":(stringcolumn("detector") eq "fcl_distance_libccd" ? column("time a pair [ns]") : NaN) with linespoints linecolor "#e3a21a" linewidth 1.8 dashtype solid pointtype 11 notitle, \
  name . "_first_contact.csv" using "shown at":(stringcolumn("detector") eq "fcl_distance_broadphase" ? column("time a pair [ns]") : NaN) with linespoints linecolor "#e3a21a" linewidth 1.8 dashtype (2,3) pointtype 2 notitle, \
  name . "_first_contact.csv" using "shown at":(stringcolumn("detector") eq "test_points_inside" ? column("time a pair [ns]") : NaN) with linespoints linecolor "#5a1fa6" linewidth 1.8 dashtype (2,3) pointtype 11 notitle, \
  "" using "shown at":(stringcolumn("detector") eq "test_points_inside" ? column("time a pair [ns]") : NaN):(column("NM") < 10 ? "" : sprintf("%g", column("NM"))) with labels font ",10" offset -2.3,-0.3 notitle, \
  name . "_first_contact.csv" using "shown at":(stringcolumn("detector") eq "test_points_vectorized" ? column("time a pair [ns]") : NaN) with linespoints linecolor "#5a1fa6" linewidth 1.8 dashtype (9,4) pointtype 8 notitle, \
  name . "_first_contact.csv" using "shown at":(stringcolumn("detector") eq "bullet_gjk" ? column("time a pair [ns]") : NaN) with linespoints linecolor "#b4b4b4" linewidth 1.8 dashtype (2,3) pointtype 1 notitle, \
  name . "_first_contact.csv" using "shown at":(stringcolumn("detector") eq "fcl_collide_libccd" ? column("time a pair [ns]") : NaN) with linespoints linecolor "#e2662e" linewidth 1.8 dashtype solid pointtype 5 notitle, \
  name . "_first_contact.csv" using "shown at":(stringcolumn("detector") eq "fcl_collide_broadphase" ? column("time a pair [ns]") : NaN) with linespoints linecolor "#e2662e" linewidth 1.8 dashtype (2,3) pointtype 12 notitle, \
  name . "_first_contact.csv" using "shown at":(stringcolumn("detector") eq "exact_distance" ? column("time a pair [ns]") : NaN) with linespoints linecolor "#b3264d" linewidth 1.8 dashtype solid pointtype 13 notitle, \
  name . "_first_contact.csv" using "shown at":(stringcolumn("detector") eq "ccd_gjk" ? column("time a pair [ns]") : NaN) with linespoints linecolor "#b4b4b4" linewidth 1.8 dashtype solid pointtype 6 notitle, \
  name . "_first_contact.csv" using "shown at":(stringcolumn("detector") eq "ccd_mpr" ? column("time a pair [ns]") : NaN) with linespoints linecolor "#b4b4b4" linewidth 1.8 dashtype (9,4) pointtype 14 notitle, \
  name . "_first_contact.csv" using "shown at":(stringcolumn("detector") eq "exact_distance_batched" ? column("time a pair [ns]") : NaN) with linespoints linecolor "#b3264d" linewidth 1.8 dashtype (9,4) pointtype 12 notitle, \
  name . "_first_contact.csv" using "shown at":(stringcolumn("detector") eq "bqsa_paper_shared" ? column("time a pair [ns]") : NaN) with linespoints linecolor "#000000" linewidth 1.8 dashtype (9,3,2,3) pointtype 6 notitle, \
  name . "_first_contact.csv" using "shown at":(stringcolumn("detector") eq "bqsa_paper" ? column("time a pair [ns]") : NaN) with linespoints linecolor "#000000" linewidth 1.8 dashtype solid pointtype 7 notitle, \
  name . "_first_contact.csv" using "shown at":(stringcolumn("detector") eq "bqsa_parameter" ? column("time a pair [ns]") : NaN) with linespoints linecolor "#000000" linewidth 1.8 dashtype (2,3) pointtype 4 notitle, \
  name . "_first_contact.csv" using "shown at":(stringcolumn("detector") eq "bqsa_space" ? column("time a pair [ns]") : NaN) with linespoints linecolor "#000000" linewidth 1.8 dashtype (9,3,2,3) pointtype 12 notitle, \
  name . "_first_contact.csv" using "shown at":(stringcolumn("detector") eq "bqsa" ? column("time a pair [ns]") : NaN) with linespoints linecolor "#000000" linewidth 1.8 dashtype (9,4) pointtype 5 notitle, \
  name . "_first_contact.csv" using "shown at":(stringcolumn("detector") eq "bqsa_batch" ? column("time a pair [ns]") : NaN) with linespoints linecolor "#000000" linewidth 1.8 dashtype (2,3) pointtype 8 notitle, \
  name . "_first_contact.csv" using "shown at":(stringcolumn("detector") eq "bqsa_batch_float" ? column("time a pair [ns]") : NaN) with linespoints linecolor "#000000" linewidth 1.8 dashtype (2,3) pointtype 10 notitle

unset multiplot
unset output
if (format eq "svg") {
  format = "png"
  reset
  load name . ".gp"
}
