# Completion of tcm-icp for fish. Options are asked of the program itself, so that they are those of its version.

function __tcm_icp_options
    set -l words (commandline -opc)
    set -l help --help
    test "$words[2]" = register; and set help --help-all
    $words[1] $words[2] $help 2>/dev/null | string match -rg '^ +(?:-[a-z] \[ )?(--[a-z][a-z.-]*)'
end

function __tcm_icp_value -a option
    set -l words (commandline -opc)
    test "$words[-1]" = "--$option"
end

complete -c tcm-icp -n __fish_use_subcommand -f -a register -d 'put scans into one frame'
complete -c tcm-icp -n __fish_use_subcommand -f -a evaluate -d 'errors of poses against ground truth'
complete -c tcm-icp -n __fish_use_subcommand -f -a degrade -d 'copies of scans with defects'
complete -c tcm-icp -n __fish_use_subcommand -f -a inspect -d 'what is known of scans before they are registered'
complete -c tcm-icp -n __fish_use_subcommand -f -a render -d 'picture of a merged cloud'
complete -c tcm-icp -n __fish_use_subcommand -f -a simulate -d 'LiDAR scans of a made-up scene'
complete -c tcm-icp -n __fish_use_subcommand -f -a sample -d 'step 1 of a registration, read scans'
complete -c tcm-icp -n __fish_use_subcommand -f -a plan -d 'step 2, which pairs to search'
complete -c tcm-icp -n __fish_use_subcommand -f -a match -d 'step 3, search a block of pairs'
complete -c tcm-icp -n __fish_use_subcommand -f -a solve -d 'step 4, poses and report'
complete -c tcm-icp -n __fish_use_subcommand -f -a write -d 'step 5, write scans in the common frame'
complete -c tcm-icp -n 'not __fish_use_subcommand; and string match -q -- "-*" (commandline -ct)' -a '(__tcm_icp_options)'
complete -c tcm-icp -n '__tcm_icp_value method' -f -a 'tcm icp features'
complete -c tcm-icp -n '__tcm_icp_value profile' -f -a 'robust paper'
complete -c tcm-icp -n '__tcm_icp_value solver' -f -a 'glpk cgal'
complete -c tcm-icp -n '__tcm_icp_value outliers' -f -a 'kmeans distance lof none'
complete -c tcm-icp -n '__tcm_icp_value refinement' -f -a 'auto none descent annealing both'
complete -c tcm-icp -n '__tcm_icp_value merge-order' -f -a 'tcm paper-tcm robust-tcm overlap file random'
complete -c tcm-icp -n '__tcm_icp_value without' -f -a 'nothing features slides implied free-space twins constant'
complete -c tcm-icp -n '__tcm_icp_value lp.formulation' -f -a 'plane point entries squares'
complete -c tcm-icp -n '__tcm_icp_value paper.matches' -f -a 'nearest threshold mutual'
complete -c tcm-icp -n '__tcm_icp_value paper.slack' -f -a 'both above below between'
complete -c tcm-icp -n '__tcm_icp_value paper.unknowns' -f -a 'entries twist'
complete -c tcm-icp -n '__tcm_icp_value paper.points' -f -a 'sample all'
complete -c tcm-icp -n '__tcm_icp_value paper.end' -f -a 'motion slack'
complete -c tcm-icp -n '__tcm_icp_value paper.descent' -f -a 'scans matches'
complete -c tcm-icp -n '__tcm_icp_value bin' -f -a 'kitti nuscenes'
complete -c tcm-icp -n '__tcm_icp_value unit' -f -a 'm mm ft us-ft'
complete -c tcm-icp -n '__tcm_icp_value scene' -f -a 'town block street urban canopy orchard tunnel motorway interior plaza bays storeys town-grid'
complete -c tcm-icp -n '__tcm_icp_value sensor' -f -a 'terrestrial spinning aerial'
