# SPDX-FileCopyrightText: The sunload authors
# SPDX-License-Identifier: GPL-3.0-or-later
"""What the gallery shows (scripts/gallery): for every study of configs its title, the commands that draw its picture (named
as the study, - for /), and what is to be seen in it. The first result that the commands name is the one whose numbers are told."""

GROUPS = {
    "Light in a town": [
        {"study": "town_day",
         "title": "A day in a small town",
         "commands": ["sunload render results/town_day/baseline.h5 --quantity sun_hours -o town_day.png"],
         "see": "Hours of sun on the longest day, from a city model: flat roofs and open land have it from morning to evening, shadows of the "
                "tower and of the rows sweep over the square, and narrow gaps between houses stay dark."},
        {"study": "rasters",
         "title": "A square from height rasters",
         "commands": ["sunload render results/rasters/baseline.h5 --quantity irradiance --time 2026-07-26T16:30 --sky plain -o rasters.png"],
         "see": "Late in the afternoon gables that look west have the most light, houses throw their shadows eastward over the square, "
                "and walls away from the sun have what sky and ground send."},
        {"study": "skyscrapers",
         "title": "Mirror glass among towers",
         "commands": ["sunload render results/skyscrapers/mirror.h5 --quantity light_load_mirror -o skyscrapers.png"],
         "see": "Light by way of the mirror tower alone, summed over a day in March and one in June: it fans out over the ground, "
                "where it adds to the sun, and climbs the tower at the right."},
        {"study": "night",
         "title": "A street at night",
         "commands": ["sunload render results/night/lanterns.h5 --quantity illuminance --scale log --sky plain -o night.png"],
         "see": "Two rows of lanterns by their photometry, in lux on a logarithmic scale: bright below and along the street, dark behind the "
                "houses, and half a lux to two on the upper windows."},
        {"study": "colours",
         "title": "A street in evening light",
         "commands": ["sunload render results/colours/baseline.h5 --colour rgb -o colours.png"],
         "see": "Three bands of light: the sun is low and red on the gables that look west, and the roofs, which it only grazes, have "
                "most of their light from the sky."},
    ],
    "What a design changes": [
        {"study": "street",
         "title": "A glass front opposite",
         "commands": ["scripts/plot/facade_map.py results/street/glazed.h5 --facade 'house_4/north*' -o street.png"],
         "see": "A facade that looks north and never has the sun itself: the house opposite is glazed, and on a spring morning its panes "
                "light the ground floor. Above, there is the light of the sky."},
        {"study": "panes",
         "title": "Panes by their angle",
         "commands": ["sunload render results/panes/panes.h5 --quantity light_load_mirror --camera top -o panes.png"],
         "see": "What double panes throw down over a day, seen from above: bright along the pavement, from those near the ground, and "
                "striped across the street, window by window."},
        {"study": "storeys",
         "title": "Two storeys more",
         "commands": ["sunload compare results/storeys/storeys-0.h5 results/storeys/storeys-2.h5 --hdf5 storeys.h5",
                      "sunload render storeys.h5 --eye=house_a3+-50,70,55 --look=house_a3+0,10,0 -o storeys.png"],
         "see": "One house, grey, is raised: its shadow falls on the land behind it (blue), and its new sunlit wall lights the row "
                "on the other side (red)."},
        {"study": "courtyard",
         "title": "A courtyard and its width",
         "commands": ["sunload render results/courtyard/w12.h5 -o courtyard.png"],
         "see": "A courtyard of 12 m, one of twelve widths: the sun stands on the rear wing, whose wall lights the one that looks north."},
        {"study": "trees",
         "title": "Trees before a facade",
         "commands": ["sunload render results/trees/in_leaf.h5 --month 10 -o trees.png"],
         "see": "In October five trees in leaf shade the lower floors behind them, and leave the floors above their crowns alone."},
    ],
    "Rules and points": [
        {"study": "measures",
         "title": "How much sky walls see",
         "commands": ["sunload render results/measures/baseline.h5 --quantity measure_sky --eye=-30,-3,14 --look=6,6,6 -o measures.png"],
         "see": "The vertical sky component of British practice, one of seven rules of the study: it falls from the eaves to the pavement, "
                "and below balconies and ledges (grey: not measured)."},
        {"study": "sensors",
         "title": "Three sensors about a box",
         "commands": ["scripts/plot/series.py results/sensors/baseline.h5 --sensor 0 --sensor 1 --sensor 2 -o sensors.png"],
         "see": "A sensor that looks east (0) has its maximum in the morning, one that looks south (1) about noon, and more of it than level "
                "ground (2), as the sun of March is low."},
    ],
    "To begin with, and to check with": [
        {"study": "minimal",
         "title": "The least study",
         "commands": ["sunload render results/minimal/baseline.h5 -o minimal.png"],
         "see": "A box on a plane in March: the wall that looks south has more than the roof, and the ground behind the box is "
                "darkest where its shadow stays longest."},
        {"study": "sun_at",
         "title": "A sun put by hand",
         "commands": ["sunload render results/sun_at/baseline.h5 -o sun_at.png"],
         "see": "Three suns of one power, in the east, south-east and south: three shadows, which overlap at the foot of the box, and "
                "a wall that looks west without any sun."},
        {"study": "two_transports",
         "title": "Two ways that must agree",
         "commands": ["scripts/plot/compare_bars.py results/two_transports/gather.h5 results/two_transports/shoot.h5 "
                      "results/two_transports/regular.h5 --by surface -o two_transports.png"],
         "see": "The same street by gathering and by two kinds of shooting: differences (right) are of the size of their 95 % whiskers."},
    ],
    "Scenes of the historic system": [
        {"study": "mcrad/windows",
         "title": "Windows that glint",
         "commands": ["sunload render results/mcrad_windows/baseline.h5 -o mcrad-windows.png"],
         "see": "Half an hour of sun on a street: each window lays a bright quadrangle on the pavement before it."},
        {"study": "mcrad/low_reflectance",
         "title": "Black, and yet in the light",
         "commands": ["sunload render results/mcrad_low_reflectance/baseline.h5 --quantity power_load -o mcrad-low_reflectance.png"],
         "see": "What surfaces send, not what they receive: a cylinder that reflects nothing is black in the sun."},
        {"study": "mcrad/room",
         "title": "A room with a lamp",
         "commands": ["sunload render results/mcrad_room/all.h5 --eye=0.3,0.3,0.6 --look=3.2,2.4,2.1 -o mcrad-room.png"],
         "see": "All reflections at once, by form factors: the ceiling behind the lamp has no light but what walls and floor send."},
        {"study": "mcrad/test_scenes",
         "title": "Shadows that a mesh must find",
         "commands": ["sunload render results/mcrad_test_scenes/geometric_accuracy_by_load.h5 --eye=-4,-11,7 --look=0,1,0.5 -o mcrad-test_scenes.png"],
         "see": "One of the global illumination test scenes: boxes that stand, tilt and float over the ground, with shadows where they "
                "belong."},
        {"study": "mcrad/sun_by_hand",
         "title": "The colour of a clear sky",
         "shown": "results/mcrad_sun_by_hand/clear.h5",
         "commands": ["sunload sky configs/mcrad/sun_by_hand.yaml --time 2000-01-01T14:30Z --colour rgb --image mcrad-sun_by_hand.png"],
         "see": "The whole sky as a fisheye sees it with the sun 20° above the west: blue overhead, pale along the horizon, reddish "
                "about the sun."},
    ],
}
